/// Membranes of triangles that are not their fabric's own: springs along edges, and Baraff and Witkin's conditions.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/cloth/joined_cloth.hpp"
#include "core/error.hpp"
#include "triangle_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// Orthotropic, with little bending.
Fabric cloth() {
  Fabric f;
  f.thickness_m = 5e-4;
  f.density_kg_per_m3 = 400;
  f.young_weft_Pa = 2e6;
  f.young_warp_Pa = 3.5e6;
  f.shear_Pa = 4e5;
  f.poisson = 0.15;
  f.law = LinearBending{{1e-6, 1e-6, 1e-6}};
  f.jam_area = 0.9;
  return f;
}

Fabric isotropic(double young_N_per_m, double poisson) {
  Fabric f = cloth();
  f.young_weft_Pa = f.young_warp_Pa = young_N_per_m / f.thickness_m;
  f.poisson = poisson;
  f.shear_Pa = f.young_weft_Pa / (2 * (1 + poisson));
  f.jam_area = 0;
  return f;
}

MembraneModel springs(double stiffness = 0, double damping = 0) {
  MembraneModel m;
  m.elements = MembraneElements::springs;
  m.spring_N_per_m = stiffness;
  m.stretch_damping_Ns_per_m = damping;
  return m;
}

MembraneModel threads(double weft = 0, double warp = 0, double shear = 0, double damping = 0, double of_shear = 0) {
  MembraneModel m;
  m.elements = MembraneElements::baraff_witkin;
  m.weft_N_per_m = weft, m.warp_N_per_m = warp, m.shear_N_per_m = shear;
  m.stretch_damping_Ns_per_m = damping, m.shear_damping_Ns_per_m = of_shear;
  return m;
}

std::vector<MembraneModel> models() {
  return {springs(), springs(700, 0.3), threads(), threads(900, 500, 120, 0.4, 0.1)};
}

MeshDraft with(MeshDraft g, const MembraneModel& membrane) {
  g.membrane = membrane;
  return g;
}

TriangleCloth sheetOf(const MembraneModel& m, const Fabric& f = cloth(), int nu = 4, int nv = 3,
                      MeshKind kind = MeshKind::single, double jitter = 0.2) {
  return clothOf(with(flatTriangles(nu, nv, 0.4, 0.3, f, kind, jitter), m));
}

/// A rhombus of equilateral triangles alone, n of them along each side, turned by an angle against the threads.
TriangleCloth rhombus(int n, const Fabric& f, const MembraneModel& m, double turned = 0, double side = 0.5) {
  MeshDraft g;
  g.mesh.patch_names = {"rhombus"};
  const double h = side / n, c = std::cos(turned), s = std::sin(turned);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = h * (i + 0.5 * j), y = h * j * std::sqrt(0.75);
      g.mesh.vertices.push_back({c * x - s * y, s * x + c * y, 0});
    }
  const auto at = [&](int i, int j) { return j * (n + 1) + i; };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      g.mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      g.mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  for (const auto& t : g.mesh.triangles) {
    g.mesh.patch.push_back(0);
    std::array<Vec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& x = g.mesh.vertices[static_cast<std::size_t>(t[k])];
      uv[k] = {x.x, x.y};
    }
    g.mesh.uv.push_back(uv);
  }
  g.fabrics = {f};
  return clothOf(with(g, m));
}

std::vector<Vec3> bent(const Cloth& c, double amplitude, unsigned seed, double squeeze = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(-amplitude, amplitude);
  std::vector<Vec3> q;
  for (const Vec3& X : c.rest())
    q.push_back({squeeze * (1.04 * X.x + 0.05 * X.y) + noise(random), squeeze * 0.97 * X.y + noise(random),
                 0.6 * X.x * X.x + 0.3 * X.x * X.y + noise(random)});
  return q;
}

double energyOf(const Cloth& c, const std::vector<Vec3>& q) {
  ClothWork work;
  std::vector<Vec3> f(q.size());
  double e = 0;
  c.force(q, f, work, &e);
  return e;
}

std::vector<Vec3> forceOf(const Cloth& c, const std::vector<Vec3>& q) {
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

double areaOf(const Cloth& c) {
  double sum = 0;
  for (const double a : c.areas()) sum += a;
  return sum;
}

/// Of one patch: a symmetric matrix by free points, which are its points.
Eigen::MatrixXd full(const Cloth& c, const BlockMatrix& K) {
  const int n = c.map().T.column_count;
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * n, 3 * n);
  for (int r = 0; r < n; ++r)
    for (long k = K.offsets[static_cast<std::size_t>(r)]; k < K.offsets[static_cast<std::size_t>(r + 1)]; ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const int s = K.columns[static_cast<std::size_t>(k)];
          out(3 * r + i, 3 * s + j) = out(3 * s + j, 3 * r + i) = K.values[static_cast<std::size_t>(9 * k + 3 * i + j)];
        }
  return out;
}

Eigen::VectorXd byFreePoints(const Cloth& c, const std::vector<Vec3>& f) {
  Eigen::VectorXd out(3 * c.map().T.column_count);
  for (int p = 0; p < c.map().T.column_count; ++p) {
    const auto home = static_cast<std::size_t>(c.map().home[static_cast<std::size_t>(p)]);
    for (int d = 0; d < 3; ++d) out[3 * p + d] = f[home][d];
  }
  return out;
}

/// 2 energies per area of (1 +- s e) over s^2, e of size 1: e . A e within s^2. e = (e11, e22, 2 e12).
double quadratic(const Cloth& c, const Vec3& e) {
  constexpr double s = 2e-4;
  double sum = 0;
  for (const double side : {-s, s}) {
    std::vector<Vec3> q;
    for (const Vec3& X : c.rest())
      q.push_back({X.x + side * (e.x * X.x + 0.5 * e.z * X.y), X.y + side * (e.y * X.y + 0.5 * e.z * X.x), X.z});
    sum += energyOf(c, q);
  }
  return sum / (s * s) / areaOf(c);
}

TEST(Membrane, ForceIsTheGradientOfTheEnergy) {
  for (const MembraneModel& m : models())
    for (const double squeeze : {1.0, 0.8}) {
      const TriangleCloth c = sheetOf(m);
      const std::vector<Vec3> q = bent(c, 2e-3, 3, squeeze), force = forceOf(c, q);
      double worst = 0;
      for (std::size_t i = 0; i < q.size(); ++i)
        for (int d = 0; d < 3; ++d) {
          constexpr double h = 1e-7;
          std::vector<Vec3> low = q, high = q;
          low[i][d] -= h, high[i][d] += h;
          worst = std::max(worst, std::abs(force[i][d] + (energyOf(c, high) - energyOf(c, low)) / (2 * h)));
        }
      EXPECT_LT(worst, 1e-6 * largest(force));
    }
}

TEST(Membrane, TangentIsTheDerivativeOfTheForce) {
  for (const MembraneModel& m : models())
    for (const double squeeze : {1.0, 0.8}) {
      const TriangleCloth c = sheetOf(m, cloth(), 3, 3, MeshKind::equilateral);
      const std::vector<Vec3> q = bent(c, 2e-3, 5, squeeze);
      const auto tangent = c.tangent();
      ClothWork work;
      BlockMatrix K = tangent->sparsity();
      tangent->assemble(q, work, K);
      const Eigen::MatrixXd ours = full(c, K);
      Eigen::MatrixXd fd = Eigen::MatrixXd::Zero(ours.rows(), ours.cols());
      constexpr double h = 1e-7;
      for (int p = 0; p < c.map().T.column_count; ++p)
        for (int d = 0; d < 3; ++d) {
          std::vector<Vec3> low = q, high = q;
          const auto at = static_cast<std::size_t>(c.map().home[static_cast<std::size_t>(p)]);
          low[at][d] -= h, high[at][d] += h;
          fd.col(3 * p + d) = (byFreePoints(c, forceOf(c, low)) - byFreePoints(c, forceOf(c, high))) / (2 * h);
        }
      EXPECT_LT((ours - fd).cwiseAbs().maxCoeff(), 2e-6 * ours.cwiseAbs().maxCoeff());
    }
}

// Pressed along one thread, springs and threads have directions that do not resist: cloth buckles.
TEST(Membrane, UnderCompressionTheTangentIsIndefinite) {
  for (const MembraneModel& m : {springs(700), threads(900, 500, 120)}) {
    const TriangleCloth c = sheetOf(m, isotropic(700, 0), 3, 3, MeshKind::single, 0);
    std::vector<Vec3> q;
    for (const Vec3& X : c.rest()) q.push_back({0.9 * X.x, X.y, 0});
    ClothWork work;
    BlockMatrix K;
    c.tangent()->assemble(q, work, K);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(full(c, K));
    EXPECT_LT(solver.eigenvalues()(0), -1e-3 * solver.eigenvalues()(solver.eigenvalues().size() - 1));
  }
}

TEST(Membrane, RigidMotionsCostNothingAndForcesHaveNoMoment) {
  const Mat3 R = rotationAbout(normalized({1, 2, -0.5}), 2.1);
  for (const MembraneModel& m : models()) {
    const TriangleCloth c = sheetOf(m);
    std::vector<Vec3> q;
    for (const Vec3& X : c.rest()) q.push_back(R * X + Vec3{3, -1, 2});
    EXPECT_LT(largest(forceOf(c, q)), 1e-9);
    EXPECT_LT(energyOf(c, q), 1e-15);
    const std::vector<Vec3> x = bent(c, 2e-3, 9), force = forceOf(c, x);
    Vec3 sum{}, moment{};
    for (std::size_t i = 0; i < x.size(); ++i) sum += force[i], moment += cross(x[i], force[i]);
    EXPECT_LT(norm(sum), 1e-12 * largest(force) * static_cast<double>(x.size()));
    EXPECT_LT(norm(moment), 1e-12 * largest(force));
  }
}

TEST(Membrane, InstructionSetsAgree) {
  for (const MembraneModel& m : models()) {
    const TriangleCloth c = sheetOf(m, cloth(), 9, 7);
    const std::vector<Vec3> q = bent(c, 2e-3, 3), v = bent(c, 0.5, 4), widest = forceOf(c, q);
    ClothWork work;
    std::vector<Vec3> damped(q.size()), force(q.size());
    ClothEnergy widest_energy, energy;
    c.dampingForce({q, {}, {}, v}, {damped, {}, {}, &widest_energy}, work);
    for (const TriangleKernels* kernels : triangleKernels()) {
      const TriangleElements e(c.points(), c.elements().triangles(), c.elements().hinges(), std::vector{cloth()},
                               *kernels, std::vector{m});
      e.force(q, {force, {}, {}, &energy}, work, {});
      EXPECT_NEAR(energy.stored / energyOf(c, q), 1, 1e-12) << kernels->name;
      for (std::size_t i = 0; i < q.size(); ++i)
        EXPECT_LT(norm(force[i] - widest[i]), 1e-11 * largest(widest)) << kernels->name;
      e.dampingForce({q, {}, {}, v}, {force, {}, {}, &energy}, work);
      EXPECT_NEAR(energy.power_W, widest_energy.power_W, 1e-12 * widest_energy.power_W) << kernels->name;
      for (std::size_t i = 0; i < q.size(); ++i)
        EXPECT_LE(norm(force[i] - damped[i]), 1e-11 * largest(damped)) << kernels->name;
    }
  }
}

// E = 2 k/sqrt(3), nu = 1/3 (two-dimensional moduli), in any direction, whatever the size of the triangles.
TEST(Membrane, EquilateralSpringsHaveTheModuliOfTheLattice) {
  constexpr double k = 500;
  for (const int n : {1, 4, 12})
    for (const double turned : {0.0, 0.3}) {
      const TriangleCloth c = rhombus(n, isotropic(1, 0), springs(k), turned);
      const double A11 = quadratic(c, {1, 0, 0}), A22 = quadratic(c, {0, 1, 0}), A33 = quadratic(c, {0, 0, 1}),
                   A12 = 0.5 * (quadratic(c, {1, 1, 0}) - A11 - A22);
      const double young = A11 - A12 * A12 / A22, nu = A12 / A22;
      EXPECT_NEAR(young / (2 * k / std::numbers::sqrt3), 1, 1e-6);
      EXPECT_NEAR(nu, 1.0 / 3, 1e-6);
      EXPECT_NEAR(A33 / (young / (2 * (1 + nu))), 1, 1e-6);
    }
}

// The same springs from a fabric with nu = 1/3: they are its membrane for small strains, and triangles say its stress.
TEST(Membrane, EquilateralSpringsOfAFabricAreItsMembrane) {
  const Fabric f = isotropic(800, 1.0 / 3);
  const TriangleCloth c = rhombus(5, f, springs()), own = rhombus(5, f, {});
  for (const Vec3& e : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0.3, -0.8, 1}})
    EXPECT_NEAR(quadratic(c, e) / quadratic(own, e), 1, 1e-6);
  std::vector<Vec3> q;
  for (const Vec3& X : c.rest()) q.push_back({(1 + 3e-6) * X.x + 2e-6 * X.y, (1 - 1e-6) * X.y, 0});
  for (const auto& [patch, place] : c.lawPlaces()) {
    const Vec3 n = c.stateAt(q, patch, place).n, exact = own.stateAt(q, patch, place).n;
    EXPECT_LT(norm(n - exact), 1e-5 * norm(exact));
  }
}

// What is printed as a limit in triangle_membrane.hpp: right-angled triangles with diagonals that cross.
TEST(Membrane, SpringsOnRightAngledTrianglesAreAnApproximation) {
  const Fabric f = isotropic(800, 1.0 / 3);
  const auto sheet = [&](const MembraneModel& m) {
    return clothOf(with(flatTriangles(8, 8, 0.4, 0.4, f, MeshKind::alternating, 0), m));
  };
  const TriangleCloth c = sheet(springs()), own = sheet({});
  const double A11 = quadratic(c, {1, 0, 0}), A12 = 0.5 * (quadratic(c, {1, 1, 0}) - 2 * A11);
  EXPECT_NEAR((A11 - A12 * A12 / A11) / 800, 1.2, 1e-3);
  EXPECT_NEAR(quadratic(c, {0, 0, 1}) / quadratic(own, {0, 0, 1}), 2.0 / 3, 1e-3);
}

// k_u = k_v = 2 k_shear: the energy of a strain does not depend on its direction.
TEST(Membrane, ThreadsWithHalfTheShearAreIsotropic) {
  const TriangleCloth c = sheetOf(threads(600, 600, 300), isotropic(1, 0), 5, 4),
                      other = sheetOf(threads(600, 600, 200), isotropic(1, 0), 5, 4);
  const auto turned = [](double a) {
    const double cs = std::cos(a), sn = std::sin(a);
    return Vec3{cs * cs, sn * sn, 2 * sn * cs};  // a stretch along one direction
  };
  for (const double a : {0.2, 0.7, 1.3}) {
    EXPECT_NEAR(quadratic(c, turned(a)) / quadratic(c, turned(0)), 1, 1e-6);
    EXPECT_GT(std::abs(quadratic(other, turned(a)) / quadratic(other, turned(0)) - 1), 1e-2);
  }
}

/// The force on the edge x = width of a sheet stretched by l along the weft, per width.
double pull(const TriangleCloth& c, double l) {
  std::vector<Vec3> q;
  for (const Vec3& X : c.rest()) q.push_back({l * X.x, X.y, 0});
  const std::vector<Vec3> f = forceOf(c, q);
  double sum = 0;
  for (std::size_t i = 0; i < q.size(); ++i)
    if (c.rest()[i].x > 0.4 - 1e-9) sum -= f[i].x;
  return sum / 0.3;
}

// P = k (l - 1), and E l (l^2 - 1)/2 of the continuum, on any mesh.
TEST(Membrane, AThreadPullsByItsLawOnAnyMesh) {
  const double k = 900;
  const Fabric f = isotropic(k, 0);
  for (const int cells : {1, 3, 9})
    for (const double l : {0.95, 1.02, 1.2}) {
      EXPECT_NEAR(pull(sheetOf(threads(k, k, 300), f, cells, cells), l), k * (l - 1), 1e-9 * k);
      EXPECT_NEAR(pull(sheetOf(threads(), f, cells, cells), l), k * (l - 1), 1e-9 * k);  // numbers of the fabric
      EXPECT_NEAR(pull(sheetOf({}, f, cells, cells), l), k * l * (l * l - 1) / 2, 1e-9 * k);
    }
}

// Energies go with the area, not with its square.
TEST(Membrane, RefinementChangesNoEnergyOfAHomogeneousStrain) {
  const auto deformed = [](const Cloth& c) {
    std::vector<Vec3> q;
    for (const Vec3& X : c.rest()) q.push_back({1.1 * X.x + 0.05 * X.y, 0.95 * X.y, 0.1 * X.x});
    return energyOf(c, q);
  };
  for (const MembraneModel& m : models()) {
    const double coarse = deformed(rhombus(1, cloth(), m, 0.2)), fine = deformed(rhombus(8, cloth(), m, 0.2));
    EXPECT_NEAR(fine / coarse, 1, 1e-12);
    if (m.elements == MembraneElements::springs) continue;  // of which right-angled meshes have other moduli
    EXPECT_NEAR(deformed(sheetOf(m, cloth(), 8, 8)) / deformed(sheetOf(m, cloth(), 2, 2)), 1, 1e-12);
  }
}

std::vector<MembraneModel> dampedModels() { return {springs(700, 0.3), threads(900, 500, 120, 0.4, 0.1)}; }

TEST(MembraneDamping, TakesPowerAndNoMomentum) {
  for (const MembraneModel& m : dampedModels()) {
    const TriangleCloth c = sheetOf(m);
    ASSERT_TRUE(c.damps());
    const std::vector<Vec3> q = bent(c, 2e-3, 3), v = bent(c, 0.5, 7);
    ClothWork work;
    std::vector<Vec3> f(q.size()), rigid(q.size());
    ClothEnergy energy;
    c.dampingForce({q, {}, {}, v}, {f, {}, {}, &energy}, work);
    double power = 0;
    Vec3 sum{}, moment{};
    for (std::size_t i = 0; i < q.size(); ++i) power -= dot(f[i], v[i]), sum += f[i], moment += cross(q[i], f[i]);
    EXPECT_GT(power, 0);
    EXPECT_NEAR(energy.power_W, power, 1e-12 * power);
    EXPECT_LT(norm(sum), 1e-12 * largest(f));
    EXPECT_LT(norm(moment), 1e-12 * largest(f));
    // D v = - f.
    BlockMatrix D;
    c.tangent()->assembleDamping({q, {}, {}, v}, work, D);
    const Eigen::MatrixXd all = full(c, D);
    EXPECT_LT((all * byFreePoints(c, v) + byFreePoints(c, f)).norm(), 1e-12 * byFreePoints(c, f).norm());
    EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(all).eigenvalues()(0), -1e-12 * all.norm());
    // Nothing of a rigid motion.
    for (std::size_t i = 0; i < q.size(); ++i) rigid[i] = Vec3{1, -2, 3} + cross(Vec3{4, 5, -6}, q[i]);
    c.dampingForce({q, {}, {}, rigid}, {f, {}, {}, &energy}, work);
    EXPECT_LT(largest(f), 1e-12);
    EXPECT_LT(energy.power_W, 1e-20);
  }
  EXPECT_FALSE(sheetOf(springs(700)).damps());
}

// Between two points alone: along the spring, of the speed along it (eq. 3.2, projected).
TEST(MembraneDamping, OfASpringIsParallelToIt) {
  const TriangleCloth c = rhombus(1, isotropic(1, 0), springs(700, 0.3));
  const std::vector<Vec3> q = c.rest();
  std::vector<Vec3> v(q.size()), f(q.size());
  v[3] = {0.3, -0.2, 0.7};  // the corner at the far end, of one triangle
  ClothWork work;
  c.dampingForce({q, {}, {}, v}, {f, {}, {}, nullptr}, work);
  Vec3 own{};
  for (const std::size_t i : {1u, 2u}) {
    const Vec3 u = normalized(q[3] - q[i]), exact = 0.15 * dot(u, v[3]) * u;  // at a border: half
    EXPECT_LT(norm(f[i] - exact), 1e-15);
    own -= exact;
  }
  EXPECT_LT(norm(f[3] - own), 1e-15);
  EXPECT_EQ(norm(f[0]), 0);
}

// Of garments with different membranes, as one cloth of triangles and as joined cloths, each has its own.
TEST(Membrane, GarmentsHaveTheirOwn) {
  std::vector<MeshDraft> drafts{flatTriangles(4, 3, 0.4, 0.3, cloth()),
                                with(flatTriangles(3, 3, 0.4, 0.3, cloth()), springs(700, 0.3)),
                                with(flatTriangles(2, 3, 0.4, 0.3, cloth()), threads(900, 500, 120, 0.4, 0.1))};
  std::vector<std::unique_ptr<const Cloth>> parts;
  for (const MeshDraft& d : drafts) parts.push_back(std::make_unique<TriangleCloth>(std::vector{d}));
  double stored = 0, power = 0;
  ClothWork work;
  for (const auto& part : parts) {
    const std::vector<Vec3> q = bent(*part, 0, 1), v = bent(*part, 0, 2, 2);
    std::vector<Vec3> f(q.size());
    ClothEnergy e;
    stored += energyOf(*part, q);
    part->dampingForce({q, {}, {}, v}, {f, {}, {}, &e}, work);
    power += e.power_W;
  }
  const TriangleCloth one(drafts);
  const JoinedCloth joined(std::move(parts));
  for (const Cloth* c : {static_cast<const Cloth*>(&one), static_cast<const Cloth*>(&joined)}) {
    const std::vector<Vec3> q = bent(*c, 0, 1), v = bent(*c, 0, 2, 2);
    std::vector<Vec3> f(q.size());
    ClothEnergy e;
    EXPECT_NEAR(energyOf(*c, q) / stored, 1, 1e-12);
    ASSERT_TRUE(c->damps());
    ClothWork own;
    c->dampingForce({q, {}, {}, v}, {f, {}, {}, &e}, own);
    EXPECT_NEAR(e.power_W / power, 1, 1e-12);
    BlockMatrix D;
    c->tangent()->assembleDamping({q, {}, {}, v}, own, D);
    EXPECT_EQ(D.values.size(), 9 * D.columns.size());
    EXPECT_LT((full(*c, D) * byFreePoints(*c, v) + byFreePoints(*c, f)).norm(), 1e-12 * byFreePoints(*c, f).norm());
  }
}

TEST(Membrane, ATensionFieldHasNoOther) {
  Fabric f = cloth();
  f.tension_field = true;
  f.jam_area = 0;
  EXPECT_THROW(sheetOf(springs(), f), InputError);
  EXPECT_THROW(sheetOf(threads(), f), InputError);
}

}  // namespace
}  // namespace gambeson
