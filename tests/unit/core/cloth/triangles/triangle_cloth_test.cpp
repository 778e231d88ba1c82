/// Cloth of triangles: gradients, patch tests, bending, samples and loads.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cloth/surface_charts.hpp"
#include "core/cloth/triangles/hinge_angle.hpp"
#include "core/error.hpp"
#include "core/statics/statics.hpp"
#include "core/statics/structure.hpp"
#include "triangle_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Fabric denim() {
  Fabric f;
  f.thickness_m = 1e-3;
  f.density_kg_per_m3 = 400;
  f.young_weft_Pa = 2e6;
  f.young_warp_Pa = 3.5e6;
  f.shear_Pa = 4e5;
  f.poisson = 0.15;
  f.law = ZhengBending{{2e-5, 5e-5, 1e-5}, 40, 2};
  return f;
}

Fabric plate(double poisson = 0) {
  Fabric f;
  f.thickness_m = 1e-2;
  f.density_kg_per_m3 = 1000;
  f.young_weft_Pa = f.young_warp_Pa = 1e6;
  f.poisson = poisson;
  f.shear_Pa = 1e6 / (2 * (1 + poisson));
  f.law = ConsistentBending{};
  return f;
}

/// A bent, stretched and noisy state of all points, joined points alike.
std::vector<Vec3> deformed(const TriangleCloth& c, double amplitude, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-amplitude, amplitude);
  std::vector<Vec3> p;
  for (int home : c.map().home) {
    const Vec3 X = c.rest()[static_cast<std::size_t>(home)];
    p.push_back({1.04 * X.x + 0.05 * X.y, 0.97 * X.y, 0.6 * X.x * X.x + 0.3 * X.x * X.y});
    p.back() += Vec3{noise(random), noise(random), noise(random)};
  }
  std::vector<Vec3> q(static_cast<std::size_t>(c.points()));
  c.map().T.multiply<Vec3>(p, q);
  return q;
}

double energyOf(const TriangleCloth& c, const std::vector<Vec3>& q) {
  ClothWork work;
  std::vector<Vec3> f(q.size());
  double e = 0;
  c.force(q, f, work, &e);
  return e;
}

std::vector<Vec3> forceOf(const TriangleCloth& c, const std::vector<Vec3>& q) {
  ClothWork work;
  std::vector<Vec3> f(q.size());
  c.force(q, f, work);
  return f;
}

double largest(const std::vector<Vec3>& v) {
  double most = 0;
  for (const Vec3& x : v) most = std::max(most, norm(x));
  return most;
}

std::vector<Fabric> fabrics() {
  Fabric tension = plate(0.2), jam = denim();
  tension.tension_field = true;
  jam.jam_area = 0.98;
  return {denim(), plate(0.3), tension, jam};
}

TEST(FoldAngle, GradientAndHessianAreItsDerivatives) {
  const HingePoints x{Vec3{0.1, 0, 0.02}, Vec3{1.2, 0.1, -0.05}, Vec3{0.5, 0.9, 0.3}, Vec3{0.7, -0.8, 0.5}};
  HingePoints gradient;
  foldAngle(x, &gradient);
  std::array<std::array<double, 9>, 16> H;
  foldAngleHessian(x, H);
  for (std::size_t J = 0; J < 4; ++J)
    for (int d = 0; d < 3; ++d) {
      constexpr double h = 1e-5;
      HingePoints low = x, high = x, g_low, g_high;
      low[J][d] -= h, high[J][d] += h;
      const double slope = (foldAngle(high, &g_high) - foldAngle(low, &g_low)) / (2 * h);
      EXPECT_NEAR(gradient[J][d], slope, 1e-9);
      for (std::size_t I = 0; I < 4; ++I)
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(H[4 * I + J][static_cast<std::size_t>(3 * i + d)], (g_high[I][i] - g_low[I][i]) / (2 * h), 1e-8);
    }
  // Up to the side of the normals is positive.
  EXPECT_GT(foldAngle({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.5, 1, 0.1}, Vec3{0.5, -1, 0.1}}, nullptr), 0);
}

/// Two triangles with a hinge between them, linear and straight at rest, whose angle of 1 rad stores 1 J. `turned`: by
/// how many corners the lists of both are turned. Cloth of no stiffness but this.
TriangleElements oneHinge(std::size_t turned, const TriangleKernels& kernels) {
  std::array<int, 3> a{0, 1, 2}, b{1, 0, 3};
  std::rotate(a.begin(), a.begin() + static_cast<long>(turned), a.end());
  std::rotate(b.begin(), b.begin() + static_cast<long>(turned), b.end());
  FoldHinge h;
  h.corner = {0, 1, 2, 3};
  h.triangle = {0, 1};
  h.per_angle = h.area_m2 = 1;
  h.d = {1, 0, 0};
  Fabric f = denim();
  f.law = LinearBending{{2, 2, 2}};
  return {4, {{a, {}, 1, 0}, {b, {}, 1, 0}}, {h}, std::vector{f}, kernels};
}

// Slivers a million times as long as the edge between them. Differences of squares of their edges leave a tenth of a
// permille; the corners themselves, rounded, 1e-10.
TEST(TriangleCloth, AHingeOfSliversPushesByTheGradientOfItsAngle) {
  const double width = 1e-6;
  const Mat3 R = rotationAbout(normalized({1, 2, -0.5}), 2.1);
  std::vector<Vec3> q;
  for (const Vec3& x : {Vec3{}, Vec3{width, 0, 0}, Vec3{0.3 * width, 1.1, 0.2}, Vec3{0.8 * width, -0.8, 0.3}})
    q.push_back(R * x);
  HingePoints gradient;
  const double theta = foldAngle({q[0], q[1], q[2], q[3]}, &gradient);
  for (const TriangleKernels* kernels : triangleKernels())
    for (std::size_t turned : {0u, 1u, 2u}) {
      ClothWork work;
      std::vector<Vec3> force(4);
      oneHinge(turned, *kernels).force(q, {force, {}, {}, nullptr}, work, {.membrane = false});
      Vec3 sum{};
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_LT(norm(force[i] + 2 * theta * gradient[i]), 1e-8 * theta) << kernels->name << " " << turned << " " << i;
        sum += force[i];
      }
      EXPECT_LT(norm(sum), 1e-14 * theta);
    }
}

TEST(TriangleCloth, ForceIsTheGradientOfTheEnergy) {
  for (const Fabric& f : fabrics())
    for (MeshKind kind : {MeshKind::single, MeshKind::alternating, MeshKind::equilateral}) {
      const TriangleCloth c = clothOf(flatTriangles(4, 3, 0.4, 0.3, f, kind, 0.2));
      std::vector<Vec3> q = deformed(c, 2e-3, 3);
      const std::vector<Vec3> force = forceOf(c, q);
      const double size = largest(force);
      double worst = 0;
      for (std::size_t i = 0; i < q.size(); ++i)
        for (int d = 0; d < 3; ++d) {
          constexpr double h = 1e-7;
          std::vector<Vec3> low = q, high = q;
          low[i][d] -= h, high[i][d] += h;
          worst = std::max(worst, std::abs(force[i][d] + (energyOf(c, high) - energyOf(c, low)) / (2 * h)));
        }
      EXPECT_LT(worst, 1e-6 * size);
    }
}

TEST(TriangleCloth, TangentIsTheDerivativeOfTheForce) {
  for (const Fabric& f : fabrics()) {
    const TriangleCloth c = clothOf(flatTriangles(3, 3, 0.3, 0.3, f, MeshKind::equilateral, 0.2));
    std::vector<Vec3> q = deformed(c, 2e-3, 5);
    const auto tangent = c.tangent();
    ClothWork work;
    BlockMatrix K = tangent->sparsity();
    tangent->assemble(q, work, K);
    const int n = c.map().T.column_count;
    Eigen::MatrixXd ours = Eigen::MatrixXd::Zero(3 * n, 3 * n), fd = ours;
    for (int r = 0; r < n; ++r)
      for (long k = K.offsets[static_cast<std::size_t>(r)]; k < K.offsets[static_cast<std::size_t>(r + 1)]; ++k)
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) {
            const int s = K.columns[static_cast<std::size_t>(k)];
            ours(3 * r + i, 3 * s + j) = ours(3 * s + j, 3 * r + i) =
                K.values[static_cast<std::size_t>(9 * k + 3 * i + j)];
          }
    constexpr double h = 1e-7;
    for (int p = 0; p < n; ++p)  // one patch: points are free points
      for (int d = 0; d < 3; ++d) {
        std::vector<Vec3> low = q, high = q;
        const auto at = static_cast<std::size_t>(c.map().home[static_cast<std::size_t>(p)]);
        low[at][d] -= h, high[at][d] += h;
        const std::vector<Vec3> a = forceOf(c, low), b = forceOf(c, high);
        for (int r = 0; r < n; ++r)
          for (int i = 0; i < 3; ++i) {
            const auto home = static_cast<std::size_t>(c.map().home[static_cast<std::size_t>(r)]);
            fd(3 * r + i, 3 * p + d) = (a[home][i] - b[home][i]) / (2 * h);
          }
      }
    EXPECT_LT((ours - fd).cwiseAbs().maxCoeff(), 2e-6 * ours.cwiseAbs().maxCoeff());
  }
}

TEST(TriangleCloth, InstructionSetsAgree) {
  for (const Fabric& f : fabrics()) {
    const TriangleCloth c = clothOf(flatTriangles(9, 7, 0.4, 0.3, f, MeshKind::single, 0.2));
    const std::vector<Vec3> q = deformed(c, 2e-3, 3), widest = forceOf(c, q);
    for (const TriangleKernels* kernels : triangleKernels()) {
      const TriangleElements elements(c.points(), c.elements().triangles(), c.elements().hinges(), std::vector{f},
                                      *kernels);
      ClothWork work;
      std::vector<Vec3> force(q.size());
      ClothEnergy energy;
      elements.force(q, {force, {}, {}, &energy}, work, {});
      EXPECT_NEAR(energy.stored / energyOf(c, q), 1, 1e-12) << kernels->name;
      for (std::size_t i = 0; i < q.size(); ++i)
        EXPECT_LT(norm(force[i] - widest[i]), 1e-11 * largest(widest)) << kernels->name;
    }
  }
}

TEST(TriangleCloth, RigidMotionsCostNothing) {
  Fabric f = denim();
  const TriangleCloth c = clothOf(flatTriangles(4, 3, 0.4, 0.3, f, MeshKind::single, 0.25));
  const Mat3 R = rotationAbout(normalized({1, 2, -0.5}), 2.1);
  std::vector<Vec3> q;
  for (const Vec3& X : c.rest()) q.push_back(R * X + Vec3{3, -1, 2});
  EXPECT_LT(largest(forceOf(c, q)), 1e-9);
  EXPECT_LT(energyOf(c, q), 1e-15);
  // Nor do forces have a sum or a moment.
  const std::vector<Vec3> bent = deformed(c, 2e-3, 9), force = forceOf(c, bent);
  Vec3 sum{}, moment{};
  for (std::size_t i = 0; i < bent.size(); ++i) sum += force[i], moment += cross(bent[i], force[i]);
  EXPECT_LT(norm(sum), 1e-12 * largest(force) * static_cast<double>(bent.size()));
  EXPECT_LT(norm(moment), 1e-12 * largest(force) * static_cast<double>(bent.size()));
}

// A homogeneous deformation leaves no force on inner vertices of any mesh, and every triangle sees it.
TEST(TriangleCloth, PatchTestOnIrregularMeshes) {
  for (unsigned seed : {1u, 2u, 3u})
    for (MeshKind kind : {MeshKind::single, MeshKind::alternating, MeshKind::equilateral}) {
      const double width = 0.6, height = 0.5;
      const TriangleCloth c = clothOf(flatTriangles(6, 5, width, height, denim(), kind, 0.3, seed));
      const Vec3 e1 = normalized({1, 0.4, 0.2}), e2 = normalized(cross({0.1, -0.3, 1}, e1));
      std::vector<Vec3> q;
      for (const Vec3& X : c.rest()) q.push_back((1.1 * X.x + 0.07 * X.y) * e1 + (0.05 * X.x + 0.93 * X.y) * e2);
      const std::vector<Vec3> force = forceOf(c, q);
      double inner = 0;
      for (std::size_t i = 0; i < q.size(); ++i) {
        const Vec3& X = c.rest()[i];
        if (X.x > 1e-9 && X.x < width - 1e-9 && X.y > 1e-9 && X.y < height - 1e-9)
          inner = std::max(inner, norm(force[i]));
      }
      EXPECT_LT(inner, 1e-10 * largest(force));
      const Vec3 exact{0.5 * (1.1 * 1.1 + 0.05 * 0.05 - 1), 0.5 * (0.07 * 0.07 + 0.93 * 0.93 - 1),
                       1.1 * 0.07 + 0.05 * 0.93};
      for (const auto& [patch, place] : c.lawPlaces()) {
        const Vec3 E = c.stateAt(q, patch, place).strain;
        EXPECT_LT(norm(E - exact), 1e-12);
      }
      const auto view = c.stress();
      const auto means = view->means(q);
      const PrincipalStress at_vertex = view->at(q, 0, {1, 0}, means), at_middle = view->at(q, 0, {2.3, 0.3}, {});
      EXPECT_NEAR(at_vertex.principal1_N_per_m, at_middle.principal1_N_per_m, 1e-9);
    }
}

// A cylinder of curvature k has the energy B k^2/2 per area, whatever the direction of its axis, on equilateral meshes
// of an isotropic sheet; the border, where half a hinge is missing, is left out by comparing two sizes.
TEST(TriangleCloth, EquilateralHingesBendAsThePlate) {
  const double k = 0.4;
  for (double angle : {0.0, 0.3, std::numbers::pi / 6, 0.9, std::numbers::pi / 2}) {
    const auto energy = [&](int cells) {
      const Fabric f = plate(0);
      const double side = 0.05;
      const TriangleCloth c = clothOf(
          flatTriangles(cells, cells, side * cells, side * cells * 0.5 * std::sqrt(3.0), f, MeshKind::equilateral));
      std::vector<Vec3> q;
      for (const Vec3& X : c.rest()) {
        const double s = std::cos(angle) * X.x + std::sin(angle) * X.y,
                     t = -std::sin(angle) * X.x + std::cos(angle) * X.y;
        q.push_back({std::sin(k * s) / k, t, (1 - std::cos(k * s)) / k});
      }
      ClothWork work;
      std::vector<Vec3> force(q.size());
      double e = 0;
      c.force(q, force, work, &e, {.membrane = false});
      return e;
    };
    const double B = 1e6 * 1e-6 / 12;
    const double area = 0.05 * 0.05 * 0.5 * std::sqrt(3.0);
    // E(n) = e n^2 + border n + corners.
    const double a = energy(8), b = energy(16), c = energy(24);
    const double per_cell2 = (a - 2 * b + c) / (2 * 8 * 8);
    EXPECT_NEAR(per_cell2 / (0.5 * B * k * k * area), 1, 0.03) << angle;
  }
}

TEST(TriangleCloth, SamplesAreItsVertices) {
  const TriangleCloth c = clothOf(flatTriangles(4, 3, 0.4, 0.3, denim(), MeshKind::single, 0.2));
  const std::vector<int> one{1};
  const Surface s = c.surface(one);
  ASSERT_EQ(s.size(), 5 * 4);
  double area = 0;
  for (double a : s.area_m2) area += a;
  EXPECT_NEAR(area, 0.12, 1e-14);
  std::vector<Vec3> x(20);
  s.W.multiply<Vec3>(c.rest(), x);
  for (std::size_t i = 0; i < 20; ++i) {
    const PlaceRow row = c.mounting().place(s.patch[i], s.parameters[i]);
    EXPECT_LT(norm(combine(row.columns, row.value, c.rest()) - x[i]), 1e-15);
  }
  double mass = 0, consistent = 0;
  for (double m : c.masses()) mass += m;
  for (double m : c.consistentMass().values) consistent += m;
  EXPECT_NEAR(mass, 0.12 * 0.4, 1e-14);
  EXPECT_NEAR(consistent, 0.12 * 0.4, 1e-14);
  // A place of the draft, and the sides.
  const Vec2 at = c.placeOfDraft(0, {0.25, 2.0 / 3});
  const PlaceRow row = c.mounting().place(0, at);
  EXPECT_LT(norm(combine(row.columns, row.value, c.rest()) - Vec3{0.1, 0.2, 0}), 0.06);  // inner vertices were moved
  EXPECT_NEAR(c.mounting().edgeLength({0, Side::v1, false}), 0.4, 1e-14);
  EXPECT_EQ(c.mounting().edgePoints({0, Side::u0, false}).size(), 4u);
  EXPECT_EQ(c.mounting().edgePoints({0, Side::u0, false}, 2).size(), 8u);
}

/// What lets contact leave out cells that cannot meet: pairs of triangles between the lines of the draft.
TEST(TriangleCloth, ADraftOnAGridHasItsCells) {
  const auto wholeCells = [](MeshKind kind) {
    const TriangleCloth c = clothOf(flatTriangles(5, 3, 0.5, 0.3, denim(), kind));
    const Surface s = c.surface({});
    std::vector<Vec3> rest(static_cast<std::size_t>(s.size()));
    s.W.multiply<Vec3>(c.rest(), rest);
    const SurfaceCharts charts = surfaceCharts(s, rest);
    for (std::size_t t = 0; t < s.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        if (s.patch_grid[0].empty()) continue;
        const Vec3& at = rest[static_cast<std::size_t>(s.triangles[t][k])];
        EXPECT_NEAR(charts.corners[t][k].x, at.x, 1e-12);
        EXPECT_NEAR(charts.corners[t][k].y, at.y, 1e-12);
      }
    return std::ranges::count(charts.charts[0].whole, 1);
  };
  EXPECT_EQ(wholeCells(MeshKind::single), 15);
  EXPECT_EQ(wholeCells(MeshKind::alternating), 15);
  EXPECT_EQ(wholeCells(MeshKind::equilateral), 0);
}

TEST(TriangleCloth, LoadsHaveTheirSumAndMoment) {
  const TriangleCloth c = clothOf(flatTriangles(4, 3, 0.4, 0.3, denim(), MeshKind::equilateral, 0.2));
  const auto total = [](const std::vector<Vec3>& f) {
    Vec3 sum{};
    for (const Vec3& v : f) sum += v;
    return sum;
  };
  const Mounting& m = c.mounting();
  EXPECT_LT(norm(total(m.surfaceForce(0, {1, 2, 3})) - 0.12 * Vec3{1, 2, 3}), 1e-14);
  EXPECT_LT(norm(total(m.edgeForce({0, Side::u1, false}, {0, 0, 2})) - Vec3{0, 0, 0.6}), 1e-14);
  EXPECT_LT(norm(total(m.weightForce({0, 0, -10})) - Vec3{0, 0, -0.48}), 1e-14);
  const Loads pressure(m, c.points(), {}, {{0, 3.0, 0}}, {});
  std::vector<Vec3> f(static_cast<std::size_t>(c.points()));
  pressure.add(c.rest(), std::vector{1.0}, f);
  EXPECT_LT(norm(total(f) - Vec3{0, 0, 0.36}), 1e-14);
  // A moment about the edge: forces without a sum, whose moment is m times the length.
  const Loads moment(m, c.points(), {}, {}, {{{0, Side::u1, false}, 2.0, 0}});
  std::fill(f.begin(), f.end(), Vec3{});
  moment.add(c.rest(), std::vector{1.0}, f);
  Vec3 turn{};
  for (std::size_t i = 0; i < f.size(); ++i) turn += cross(c.rest()[i], f[i]);
  EXPECT_LT(norm(total(f)), 1e-13);
  EXPECT_LT(norm(turn - Vec3{0, 0.6, 0}), 1e-13);
}

// A strip clamped at one end and loaded at the other, small: the tip of the beam, w = F L^3/(3 B b), on equilateral
// meshes. (On single ones hinges couple bending along an edge with twist, and a narrow strip is up to twice too soft.)
TEST(TriangleCloth, ACantileverBendsAsTheBeam) {
  for (int cells : {8, 16, 32}) {
    const Fabric f = plate(0);
    StructureOptions o;
    const double length = 1, width = 0.2, B = 1e6 * 1e-6 / 12, force = 1e-5;
    auto c = std::make_unique<TriangleCloth>(std::vector<MeshDraft>{
        flatTriangles(cells, std::max(2, cells / 4), length, width, f, MeshKind::equilateral)});
    const Vec3 all[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const PatchEdge clamp{0, Side::u0, false}, tip{0, Side::u1, false};
    o.constraints = c->mounting().holdEdge(clamp, all, {});
    for (LinearConstraint& l : c->mounting().clampEdge(clamp)) o.constraints.push_back(std::move(l));
    o.dead = {{c->mounting().edgeForce(tip, {0, 0, force / width}), 0}};
    const PlaceRow at = c->mounting().place(0, c->placeOfDraft(0, {1, 0.5}));
    const auto s = buildStructure(std::move(c), o);
    double w = 0;
    const StaticReport r = solveStatic(*s, {.steps = 1}, [&](const StaticPoint& p) {
      const std::vector<Vec3> q = controlPoints(*s, p.y, p.factor);
      w = combine(at.columns, at.value, q).z;
      return true;
    });
    ASSERT_TRUE(r.reached) << r.why;
    EXPECT_NEAR(w / (force * length * length * length / (3 * B * width)), 1, 0.03);
  }
}

TEST(TriangleCloth, RefusesWhatIsNoCloth) {
  MeshDraft g = flatTriangles(2, 2, 1, 1, denim());
  MeshDraft bad = g;
  bad.mesh.triangles[1] = bad.mesh.triangles[0];
  EXPECT_THROW(clothOf(bad), InputError);
  bad = g;
  bad.mesh.vertices.push_back({});
  EXPECT_THROW(clothOf(bad), InputError);
  bad = g;
  bad.mesh.vertices[4].x = std::nan("");
  EXPECT_THROW(clothOf(bad), InputError);
  bad = g;
  bad.mesh.uv.clear();
  bad.rest = MeshRest::flat;
  EXPECT_THROW(clothOf(bad), InputError);
  bad = g;
  bad.fabrics[0].law = Laminate{{{1e-3, 1e6, 1e6, 4e5, 0.2, 0}, {1e-3, 5e6, 1e6, 4e5, 0.2, 0}}};
  EXPECT_THROW(clothOf(bad), InputError);
  bad = g;
  bad.mesh.lines[0].vertices = {0, 8};
  EXPECT_THROW(clothOf(bad), InputError);
}

}  // namespace
}  // namespace gambeson
