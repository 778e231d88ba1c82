/// Triangles that bend by their tensor of curvature: gradients, rigid motions, tangents, directions, plates and beams.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cloth/joined_cloth.hpp"
#include "core/cloth/triangles/triangle_cloth.hpp"
#include "core/error.hpp"
#include "core/material/hysteresis.hpp"
#include "core/motion/implicit.hpp"
#include "core/motion/motion_audit.hpp"
#include "core/motion/step.hpp"
#include "core/motion/structure_motion.hpp"
#include "unit/core/motion/motion_shapes.hpp"
#include "core/statics/modal.hpp"
#include "core/statics/statics.hpp"
#include "core/statics/structure_system.hpp"
#include "triangle_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr double kB = 1e6 * 1e-6 / 12;  ///< of the plate [N m]

Fabric plate() {
  Fabric f;
  f.thickness_m = 1e-2;
  f.density_kg_per_m3 = 1000;
  f.young_weft_Pa = f.young_warp_Pa = 1e6;
  f.poisson = 0;
  f.shear_Pa = 0.5e6;
  f.law = ConsistentBending{};
  return f;
}

Fabric unlike() {
  Fabric f = plate();
  f.law = ZhengBending{{2e-5, 5e-5, 1e-5}, 40, 2};
  return f;
}

Fabric folding() {
  Fabric f = plate();
  f.law = StopBending{{2e-5, 3e-5, 1e-5}, 1e-5};
  return f;
}

std::vector<Fabric> fabrics() { return {plate(), unlike(), folding()}; }

constexpr BendingElements kTensors[] = {BendingElements::midedge, BendingElements::triangle};

TriangleCloth clothOf(BendingElements bending, int nu, int nv, double width, double height, const Fabric& fabric,
                      MeshKind kind, double jitter = 0, unsigned seed = 1) {
  MeshDraft g = flatTriangles(nu, nv, width, height, fabric, kind, jitter, seed);
  g.bending = bending;
  return shapes::clothOf(std::move(g));
}

/// A bent, stretched and noisy state, with rotations of edges.
struct Bent {
  std::vector<Vec3> q;
  std::vector<double> inner, history;

  Bent(const TriangleCloth& c, double amplitude, unsigned seed) : inner(c.innerValues()), history(c.historySize()) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> noise(-1, 1);
    for (const Vec3& X : c.rest()) {
      q.push_back({1.04 * X.x + 0.05 * X.y, 0.97 * X.y, 0.6 * X.x * X.x + 0.3 * X.x * X.y});
      q.back() += amplitude * Vec3{noise(random), noise(random), noise(random)};
    }
    for (double& phi : inner) phi = 0.1 * noise(random);
  }
  ClothState state() const { return {q, inner, history}; }
};

struct Forces {
  std::vector<Vec3> points;
  std::vector<double> inner;
  double energy = 0;

  Forces(const TriangleCloth& c, const ClothState& s, const ForceTerms& terms = {})
      : points(s.q.size()), inner(c.innerRates()) {
    ClothWork work;
    ClothEnergy e;
    c.force(s, {points, inner, {}, &e}, work, terms);
    energy = e.stored + e.lost;
  }
};

double largest(const std::vector<Vec3>& v) {
  double most = 0;
  for (const Vec3& x : v) most = std::max(most, norm(x));
  return most;
}
double largest(const std::vector<double>& v) {
  double most = 0;
  for (const double x : v) most = std::max(most, std::abs(x));
  return most;
}

ForceTerms bendingAlone() {
  ForceTerms terms;
  terms.membrane = false;
  return terms;
}

TEST(BendingTriangles, ForceIsTheGradientOfTheEnergy) {
  for (const BendingElements bending : kTensors)
    for (const Fabric& f : fabrics())
      for (MeshKind kind : {MeshKind::single, MeshKind::alternating, MeshKind::equilateral}) {
        const TriangleCloth c = clothOf(bending, 4, 3, 0.4, 0.3, f, kind, 0.2);
        EXPECT_EQ(c.innerRates() > 0, bending == BendingElements::midedge);
        const Bent s(c, 2e-3, 3);
        const Forces at(c, s.state(), bendingAlone());
        double worst = 0, worst_inner = 0;
        constexpr double h = 1e-7;
        const auto slope = [&](auto&& move) {
          Bent low = s, high = s;
          move(low, -h), move(high, h);
          return (Forces(c, high.state(), bendingAlone()).energy - Forces(c, low.state(), bendingAlone()).energy) /
                 (2 * h);
        };
        for (std::size_t i = 0; i < s.q.size(); ++i)
          for (int d = 0; d < 3; ++d)
            worst = std::max(worst, std::abs(at.points[i][d] + slope([&](Bent& b, double by) { b.q[i][d] += by; })));
        for (std::size_t k = 0; k < s.inner.size(); ++k)
          worst_inner =
              std::max(worst_inner, std::abs(at.inner[k] + slope([&](Bent& b, double by) { b.inner[k] += by; })));
        EXPECT_LT(worst, 1e-6 * largest(at.points));
        EXPECT_LE(worst_inner, 1e-6 * largest(at.inner));
      }
}

TEST(BendingTriangles, RigidMotionsCostNothingAndForcesHaveNoTorque) {
  for (const BendingElements bending : kTensors) {
    const TriangleCloth c = clothOf(bending, 4, 3, 0.4, 0.3, unlike(), MeshKind::single, 0.25);
    const Mat3 R = rotationAbout(normalized({1, 2, -0.5}), 2.1);
    std::vector<Vec3> q;
    for (const Vec3& X : c.rest()) q.push_back(R * X + Vec3{3, -1, 2});
    const std::vector<double> still(c.innerValues());
    const Forces rigid(c, {q, still, {}}, bendingAlone());
    const Bent s(c, 2e-3, 9);
    const Forces bent(c, s.state(), bendingAlone());
    EXPECT_LT(largest(rigid.points), 1e-12 * largest(bent.points));
    EXPECT_LE(largest(rigid.inner), 1e-12 * largest(bent.inner));
    Vec3 sum{}, moment{};
    for (std::size_t i = 0; i < s.q.size(); ++i) sum += bent.points[i], moment += cross(s.q[i], bent.points[i]);
    EXPECT_LT(norm(sum), 1e-12 * largest(bent.points));
    EXPECT_LT(norm(moment), 1e-12 * largest(bent.points));
  }
}

/// K of all components against differences of the forces.
TEST(BendingTriangles, TangentIsTheDerivativeOfTheForce) {
  for (const BendingElements bending : kTensors)
    for (const Fabric& f : fabrics()) {
      const TriangleCloth c = clothOf(bending, 3, 2, 0.3, 0.2, f, MeshKind::alternating, 0.2);
      const Bent s(c, 2e-3, 5);
      const auto tangent = c.tangent();
      ClothWork work;
      BlockMatrix K = tangent->sparsity();
      tangent->assemble(s.state(), work, K, bendingAlone());
      const int points = c.map().T.column_count, n = 3 * points + static_cast<int>(c.innerRates());
      ASSERT_EQ(K.rows(), points + c.innerBlocks());
      Eigen::MatrixXd ours = Eigen::MatrixXd::Zero(3 * K.rows(), 3 * K.rows()), fd = ours;
      for (int r = 0; r < K.rows(); ++r)
        for (long k = K.offsets[static_cast<std::size_t>(r)]; k < K.offsets[static_cast<std::size_t>(r + 1)]; ++k)
          for (int e = 0; e < 9; ++e) {
            const int a = 3 * r + e / 3, b = 3 * K.columns[static_cast<std::size_t>(k)] + e % 3;
            ours(a, b) = ours(b, a) = K.values[static_cast<std::size_t>(9 * k + e)];
          }
      constexpr double h = 1e-6;
      for (int j = 0; j < n; ++j) {
        const auto moved = [&](double by) {
          Bent b = s;
          if (j < 3 * points)  // one patch: points are free points
            b.q[static_cast<std::size_t>(c.map().home[static_cast<std::size_t>(j / 3)])][j % 3] += by;
          else
            b.inner[static_cast<std::size_t>(j - 3 * points)] += by;
          const Forces at(c, b.state(), bendingAlone());
          Eigen::VectorXd all = Eigen::VectorXd::Zero(3 * K.rows());
          for (int p = 0; p < points; ++p)
            for (int d = 0; d < 3; ++d)
              all(3 * p + d) = at.points[static_cast<std::size_t>(c.map().home[static_cast<std::size_t>(p)])][d];
          for (std::size_t k = 0; k < at.inner.size(); ++k) all(3 * points + static_cast<long>(k)) = at.inner[k];
          return all;
        };
        fd.col(j) = (moved(-h) - moved(h)) / (2 * h);
      }
      EXPECT_LT((ours - fd).cwiseAbs().maxCoeff(), 2e-6 * ours.cwiseAbs().maxCoeff());
    }
}

TEST(BendingTriangles, InstructionSetsAgree) {
  for (const BendingElements bending : kTensors)
    for (const Fabric& f : fabrics()) {
      const TriangleCloth c = clothOf(bending, 9, 7, 0.4, 0.3, f, MeshKind::single, 0.2);
      const Bent s(c, 2e-3, 3);
      const Forces widest(c, s.state());
      for (const TriangleKernels* kernels : triangleKernels()) {
        const TriangleElements elements(c.points(), c.elements().triangles(), c.elements().hinges(), std::vector{f},
                                        *kernels);
        ClothWork work;
        std::vector<Vec3> points(s.q.size());
        std::vector<double> inner(s.inner.size());
        ClothEnergy energy;
        elements.force({s.q, s.inner, {}}, {points, inner, {}, &energy}, work, {});
        EXPECT_NEAR((energy.stored + energy.lost) / widest.energy, 1, 1e-12) << kernels->name;
        for (std::size_t i = 0; i < points.size(); ++i)
          EXPECT_LT(norm(points[i] - widest.points[i]), 1e-11 * largest(widest.points)) << kernels->name;
        for (std::size_t k = 0; k < inner.size(); ++k)
          EXPECT_LT(std::abs(inner[k] - widest.inner[k]), 1e-11 * largest(widest.inner)) << kernels->name;
      }
    }
}

/// Crossed springs: force against energy, tangent against force, no torque; what they store at the curvature that they
/// are made for, and how little below it.
TEST(CrossedSprings, ForceTangentAndEnergy) {
  for (const double jitter : {0.0, 0.2}) {
    const TriangleCloth c = clothOf(BendingElements::springs, 4, 3, 0.04, 0.03, plate(), MeshKind::single, jitter);
    EXPECT_EQ(c.innerRates(), 0u);
    EXPECT_EQ(c.elements().springs().springs().size(), c.elements().hinges().size());
    const Bent s(c, 2e-4, 3);
    const Forces at(c, s.state(), bendingAlone());
    const auto tangent = c.tangent();
    ClothWork work;
    BlockMatrix K = tangent->sparsity();
    tangent->assemble(s.state(), work, K, bendingAlone());
    Vec3 sum{}, moment{};
    for (std::size_t i = 0; i < s.q.size(); ++i) sum += at.points[i], moment += cross(s.q[i], at.points[i]);
    EXPECT_LT(norm(sum), 1e-12 * largest(at.points));
    EXPECT_LT(norm(moment), 1e-12 * largest(at.points));
    std::mt19937 random(7);
    std::uniform_real_distribution<double> noise(-1, 1);
    std::vector<double> way(3 * static_cast<std::size_t>(K.rows())), Kway(way.size());
    for (double& w : way) w = noise(random);
    multiply(K, way, Kway);
    constexpr double h = 1e-8;
    Bent low = s, high = s;
    double work_rate = 0;
    for (int p = 0; p < c.map().T.column_count; ++p)
      for (int d = 0; d < 3; ++d) {
        const auto i = static_cast<std::size_t>(c.map().home[static_cast<std::size_t>(p)]);
        const double w = way[static_cast<std::size_t>(3 * p + d)];
        low.q[i][d] -= h * w, high.q[i][d] += h * w;
        work_rate -= at.points[i][d] * w;
      }
    const Forces before(c, low.state(), bendingAlone()), after(c, high.state(), bendingAlone());
    EXPECT_NEAR((after.energy - before.energy) / (2 * h), work_rate, 1e-6 * std::abs(work_rate));
    double worst = 0, most = 0;
    for (int p = 0; p < c.map().T.column_count; ++p)
      for (int d = 0; d < 3; ++d) {
        const auto i = static_cast<std::size_t>(c.map().home[static_cast<std::size_t>(p)]);
        const double ours = Kway[static_cast<std::size_t>(3 * p + d)];
        worst = std::max(worst, std::abs(ours - (before.points[i][d] - after.points[i][d]) / (2 * h)));
        most = std::max(most, std::abs(ours));
      }
    EXPECT_LT(worst, 1e-6 * most);
  }
}

TEST(CrossedSprings, StoreWhatHingesDoAtOneCurvature) {
  // Two equilateral triangles, folded.
  constexpr double side = 0.01;
  const double height = side * 0.5 * std::sqrt(3.0);
  Fabric f = plate();
  f.law = LinearBending{{kB, kB, 0.5 * kB}};
  const auto energy = [&](BendingElements bending, double theta) {
    MeshDraft g;
    g.mesh.vertices = {{0, 0, 0}, {side, 0, 0}, {0.5 * side, height, 0}, {0.5 * side, -height, 0}};
    g.mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
    g.mesh.patch = {0, 0};
    g.mesh.patch_names = {"cloth"};
    g.fabrics = {f};
    g.bending = bending;
    const TriangleCloth c = shapes::clothOf(std::move(g));
    std::vector<Vec3> q = c.rest();
    for (Vec3& x : q)
      if (x.y < -1e-9) x = {x.x, -height * std::cos(theta), height * std::sin(theta)};
    return Forces(c, q, bendingAlone()).energy;
  };
  const double theta = 100 * height;  // 1/cm
  EXPECT_NEAR(energy(BendingElements::springs, theta) / energy(BendingElements::hinge, theta), 1, 1e-12);
  EXPECT_LT(energy(BendingElements::springs, 0.1 * theta), 0.02 * energy(BendingElements::hinge, 0.1 * theta));
}

TEST(CrossedSprings, RefuseLawsThatRemember) {
  EXPECT_THROW(clothOf(BendingElements::springs, 2, 2, 1, 1, folding(), MeshKind::single), InputError);
}

/// omega L^2 sqrt(rho/B) of the lowest modes of a free square plate beyond the rigid ones.
std::vector<double> plateNumbers(BendingElements bending, int n, MeshKind kind, double jitter, double inertia = 1) {
  Fabric f = plate();
  const double L = 1;
  StructureOptions o;
  MeshDraft draft = flatTriangles(n, n, L, L, f, kind, jitter);
  draft.bending = bending;
  std::vector<MeshDraft> garments;
  garments.push_back(std::move(draft));
  std::unique_ptr<Structure> s = buildStructure(std::make_unique<TriangleCloth>(std::move(garments)), o);
  for (double& m : s->inner_mass) m *= inertia;
  std::vector<double> numbers;
  for (const Mode& m : naturalModes(*s, {}, 0, 9, true))
    if (numbers.size() < 3 && m.omega_rad_per_s > 1e-3)
      numbers.push_back(m.omega_rad_per_s * L * L * std::sqrt(f.surfaceDensity() / kB));
  return numbers;
}

/// 15.83, 22.37, 22.37 (Wong 2014 against thin-plate theory with nu = 0); the inertia of the edges is not seen. Those
/// of hinges and of triangles without unknowns depend on the mesh (tests/verify/wong_plate.json).
TEST(BendingTriangles, AFreePlateHasItsFrequencies) {
  for (const MeshKind kind : {MeshKind::single, MeshKind::alternating}) {  // vertices moved by 0.15 of a cell
    const std::vector<double> w = plateNumbers(BendingElements::midedge, 20, kind, 0.15);
    ASSERT_EQ(w.size(), 3u);
    EXPECT_NEAR(w[0], 15.83, 0.015 * 15.83);
    EXPECT_NEAR(w[1], 22.37, 0.015 * 22.37);
    EXPECT_NEAR(w[2], 22.37, 0.015 * 22.37);
  }
  const std::vector<double> w = plateNumbers(BendingElements::midedge, 10, MeshKind::single, 0),
                            massless = plateNumbers(BendingElements::midedge, 10, MeshKind::single, 0, 1e-3);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(w[k], massless[k], 1e-3 * w[k]);
}

/// The largest frequency of a sheet that bends and does little else [rad/s].
double largestOf(BendingElements bending, MeshKind kind, double jitter, double aspect) {
  Fabric f = plate();
  f.young_weft_Pa = f.young_warp_Pa = 1e-3;
  f.shear_Pa = 0.5e-3;
  f.law = LinearBending{{kB, kB, 0.5 * kB}};
  MeshDraft draft = flatTriangles(12, 12, 1, aspect, f, kind, jitter);
  draft.bending = bending;
  std::vector<MeshDraft> garments;
  garments.push_back(std::move(draft));
  ModelOptions o;
  o.self_contact = false;
  const auto model = buildModel(std::make_unique<TriangleCloth>(std::move(garments)), o, {Vec3{}, 0}, {}, {});
  const UniformStage stage;
  StepWork work;
  State state = initialState(*model, stage, 0, work);
  return largestFrequency(*model, stage, state, 120, work).largest_rad_per_s;
}

/// The inertia of the edges' unknowns costs next to no time step, even of sheets whose bending governs it: on
/// equilateral meshes the halves of triangles at the border a tenth.
TEST(BendingTriangles, EdgesCostNoStableStep) {
  for (const double aspect : {1.0, 0.5})
    for (const auto& [kind, jitter] :
         {std::pair(MeshKind::single, 0.0), std::pair(MeshKind::alternating, 0.0),
          std::pair(MeshKind::equilateral, 0.0), std::pair(MeshKind::single, 0.25)}) {
      const double hinge = largestOf(BendingElements::hinge, kind, jitter, aspect),
                   midedge = largestOf(BendingElements::midedge, kind, jitter, aspect);
      EXPECT_LT(midedge, (kind == MeshKind::equilateral ? 1.1 : 1.03) * hinge);
    }
}

/// A sheet that flies and bends: total energy stays, the second order of the scheme; threads change no bit.
TEST(BendingTriangles, FreeMotionKeepsItsEnergy) {
  std::vector<double> drift;
  for (const double steps : {1.0, 2.0}) {
    Fabric f = plate();
    MeshDraft draft = flatTriangles(8, 8, 0.3, 0.3, f, MeshKind::alternating, 0.1);
    draft.bending = BendingElements::midedge;
    std::vector<MeshDraft> garments;
    garments.push_back(std::move(draft));
    ModelOptions o;
    o.self_contact = false;
    const auto model = buildModel(std::make_unique<TriangleCloth>(std::move(garments)), o, {Vec3{}, 0}, {}, {});
    const UniformStage stage;
    StepWork work;
    State state = initialState(*model, stage, 0, work), next;
    for (std::size_t i = 0; i < state.p.size(); ++i) state.v[i] = {0, 0, 0.4 * std::cos(20 * state.p[i].x)};
    attachSprings(*model, stage, state, work);
    const double dt = 0.25 * 2 / largestFrequency(*model, stage, state, 60, work).largest_rad_per_s / steps;
    const double start = energyOf(*model, stage, state, work).total();
    double worst = 0;
    for (int k = 0; k < 200 * steps; ++k) {
      ASSERT_EQ(step(*model, stage, state, dt, next, work).failure, StepFailure::none);
      std::swap(state, next);
      worst = std::max(worst, std::abs(energyOf(*model, stage, state, work).total() - start));
    }
    double turned = 0;
    for (const double phi : state.inner) turned = std::max(turned, std::abs(phi));
    EXPECT_GT(turned, 1e-3);
    drift.push_back(worst / start);
  }
  EXPECT_LT(drift[0], 0.02);
  EXPECT_NEAR(std::log2(drift[0] / drift[1]), 2, 0.3);
}

/// The rates of joined cloths are packed three by three anew.
TEST(BendingTriangles, JoinedClothHasTheTangentOfBoth) {
  std::vector<std::unique_ptr<const Cloth>> parts;
  for (const int cells : {2, 3}) {
    MeshDraft draft = flatTriangles(cells, 2, 0.1 * cells, 0.2, unlike(), MeshKind::single, 0.1);
    draft.bending = BendingElements::midedge;
    std::vector<MeshDraft> garments;
    garments.push_back(std::move(draft));
    parts.push_back(std::make_unique<TriangleCloth>(std::move(garments)));
  }
  ASSERT_NE(parts[0]->innerRates() % 3, 0u);
  const JoinedCloth c(std::move(parts));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-1, 1);
  std::vector<Vec3> q, way(c.rest().size());
  std::vector<double> inner(c.innerValues()), turn(inner.size());
  for (const Vec3& X : c.rest()) q.push_back(X + Vec3{0, 0, 2 * X.x * X.x} + 1e-3 * Vec3{0, 0, noise(random)});
  for (double& phi : inner) phi = 0.1 * noise(random);
  for (Vec3& w : way) w = {noise(random), noise(random), noise(random)};
  for (double& t : turn) t = 10 * noise(random);
  const auto tangent = c.tangent();
  ClothWork work;
  BlockMatrix K = tangent->sparsity();
  tangent->assemble({q, inner, {}}, work, K, bendingAlone());
  const std::size_t points = c.map().home.size();
  std::vector<double> x(3 * static_cast<std::size_t>(K.rows())), Kx(x.size());
  for (std::size_t p = 0; p < points; ++p)
    for (int d = 0; d < 3; ++d)
      x[3 * p + static_cast<std::size_t>(d)] = way[static_cast<std::size_t>(c.map().home[p])][d];
  for (std::size_t k = 0; k < turn.size(); ++k) x[3 * points + k] = turn[k];
  multiply(K, x, Kx);
  const auto forces = [&](double h) {
    std::vector<Vec3> moved = q, f(q.size());
    std::vector<double> turned = inner, g(inner.size()), all(x.size());
    for (std::size_t i = 0; i < q.size(); ++i) moved[i] += h * way[i];
    for (std::size_t k = 0; k < inner.size(); ++k) turned[k] += h * turn[k];
    c.force({moved, turned, {}}, {f, g, {}, nullptr}, work, bendingAlone());
    for (std::size_t p = 0; p < points; ++p)
      for (int d = 0; d < 3; ++d)
        all[3 * p + static_cast<std::size_t>(d)] = f[static_cast<std::size_t>(c.map().home[p])][d];
    for (std::size_t k = 0; k < g.size(); ++k) all[3 * points + k] = g[k];
    return all;
  };
  const std::vector<double> low = forces(-1e-7), high = forces(1e-7);
  double worst = 0;
  for (std::size_t i = 0; i < x.size(); ++i) worst = std::max(worst, std::abs(Kx[i] - (low[i] - high[i]) / 2e-7));
  EXPECT_LT(worst, 1e-5 * largest(Kx));
}

/// Cloth that starts bent starts with its edges at rest.
TEST(BendingTriangles, EdgesOfBentClothSettle) {
  MeshDraft draft = flatTriangles(8, 8, 0.3, 0.3, unlike(), MeshKind::single, 0.1);
  draft.bending = BendingElements::midedge;
  std::vector<MeshDraft> garments;
  garments.push_back(std::move(draft));
  ModelOptions o;
  o.self_contact = false;
  const auto model = buildModel(std::make_unique<TriangleCloth>(std::move(garments)), o, {Vec3{}, 0}, {}, {});
  const UniformStage stage;
  StepWork work;
  State state = initialState(*model, stage, 0, work);
  for (Vec3& p : state.p) p.z = 2 * p.x * p.x + p.x * p.y;
  attachSprings(*model, stage, state, work);
  const double before = largest(state.inner_acceleration);
  settleInner(*model, state, work);
  attachSprings(*model, stage, state, work);
  EXPECT_GT(before, 0);
  EXPECT_LT(largest(state.inner_acceleration), 1e-4 * before);
}

/// A clamped strip under a load that is put on slowly, by explicit and implicit steps: the static deflection.
TEST(BendingTriangles, MotionsComeToRestWhereStaticsSay) {
  Fabric f = plate();
  f.young_weft_Pa = f.young_warp_Pa = 1e7;
  f.shear_Pa = 0.5e7;
  f.law = LinearBending{{1, 1, 0.5}};
  MeshDraft draft = flatTriangles(6, 2, 0.12, 0.04, f, MeshKind::single);
  draft.bending = BendingElements::midedge;
  std::vector<MeshDraft> garments;
  garments.push_back(std::move(draft));
  auto c = std::make_unique<TriangleCloth>(std::move(garments));
  StructureOptions o;
  const PatchEdge clamp{0, Side::u0, false}, tip{0, Side::u1, false};
  const Vec3 all[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  o.constraints = c->mounting().holdEdge(clamp, all, {});
  for (LinearConstraint& l : c->mounting().clampEdge(clamp)) o.constraints.push_back(std::move(l));
  o.moments = {{tip, 2, 0}};
  o.programs = {{{0, 0.1, 1}, {0, 1, 1}}};
  o.rayleigh_mass_per_s = 150;  // critical
  const int end = c->sidePoints(tip)[0];
  const auto s = buildStructure(std::move(c), o);
  double still = 0;
  const StaticReport r = solveStatic(*s, {.steps = 4}, [&](const StaticPoint& p) {
    still = controlPoints(*s, p.y, p.factor)[static_cast<std::size_t>(end)].z;
    return true;
  });
  ASSERT_TRUE(r.reached) << r.why;
  ASSERT_GT(std::abs(still), 0.01);
  State state = structureState(*s, 0, std::vector<double>(static_cast<std::size_t>(s->dofs.unknowns()), 0.0), {}, {});
  ImplicitOptions implicit;
  implicit.step_s = 0.01;
  implicit.spectral_radius = 0.5;
  ImplicitSteps(*s, implicit).advance(0.5, state, [](auto&&...) {});
  EXPECT_NEAR(controlPoints(*s, state)[static_cast<std::size_t>(end)].z / still, 1, 1e-4);

  const auto model = untouchedModel(*s);
  const UniformStage stage;
  StepWork work;
  State moving = initialState(*model, stage, 0, work), next;
  const double dt = 0.8 * 2 / largestFrequency(*model, stage, moving, 60, work).largest_rad_per_s;
  MotionAudit audit(*s, true);
  while (moving.time_s < 0.5) {
    const StepReport report = step(*model, stage, moving, dt, next, work);
    ASSERT_EQ(report.failure, StepFailure::none);
    audit.observe(moving, next, report);
    std::swap(moving, next);
  }
  EXPECT_NEAR(controlPoints(*s, moving)[static_cast<std::size_t>(end)].z / still, 1, 1e-4);
  EXPECT_LT(audit.largestEnergyGap(), 1e-3 * audit.works());
}

}  // namespace
}  // namespace gambeson
