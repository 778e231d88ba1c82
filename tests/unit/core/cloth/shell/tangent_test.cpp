// The consistent tangent: the derivative of the force, symmetric, blind to rigid motion, the same bits for any threads.
#include "core/cloth/shell/tangent.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cstring>

#include "core/error.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// K as a full matrix of 3 n rows.
std::vector<std::vector<double>> dense(const BlockMatrix& K) {
  const int n = K.rows();
  std::vector<std::vector<double>> full(3 * n, std::vector<double>(3 * n, 0.0));
  for (int r = 0; r < n; ++r)
    for (long k = K.offsets[r]; k < K.offsets[r + 1]; ++k)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          full[3 * r + i][3 * K.columns[k] + j] = K.values[9 * k + 3 * i + j];
          full[3 * K.columns[k] + j][3 * r + i] = K.values[9 * k + 3 * i + j];
        }
  return full;
}

double largest(const std::vector<std::vector<double>>& m) {
  double most = 0;
  for (const auto& row : m)
    for (double v : row) most = std::max(most, std::abs(v));
  return most;
}

struct Options {
  const KernelSet* kernels = &widestKernels();
  ForceTerms terms;
  double size = 0.02, step = 2e-4;
};

/// The worst entry of K against central differences of the force, with one Richardson step, over the largest entry.
double tangentError(const Garment& g, const Options& o = {}) {
  const Shell shell(g, *o.kernels);
  const FreeMap map = buildFreeMap(g);
  const Tangent tangent(shell, map);
  std::vector<Vec3> p = deformedFree(g, map, o.size);
  ClothWork work;
  BlockMatrix K;
  tangent.assemble(shell, controlsOf(map, p), work, K, o.terms);
  const auto full = dense(K);
  const double scale = largest(full);
  double worst = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto force = [&](double step) {
        const double old = p[i][c];
        p[i][c] += step;
        const auto f = onFree(map, forceOn(shell, controlsOf(map, p), nullptr, o.terms));
        p[i][c] = old;
        return f;
      };
      const double h = o.step;
      const auto f1 = force(h), f2 = force(-h), f3 = force(2 * h), f4 = force(-2 * h);
      for (std::size_t j = 0; j < p.size(); ++j)
        for (int d = 0; d < 3; ++d) {
          const double slope = -(8 * (f1[j][d] - f2[j][d]) - (f3[j][d] - f4[j][d])) / (12 * h);
          worst = std::max(worst, std::abs(slope - full[3 * j + d][3 * i + c]) / scale);
        }
    }
  return worst;
}

Fabric consistentFabric() {
  Fabric f = plainFabric();
  f.law = ConsistentBending{};
  f.thickness_m = 0.1;
  return f;
}

/// Two plies that couple membrane and bending, and shear with all.
Fabric unsymmetricLaminate() {
  Fabric f = plainFabric();
  f.law = Laminate{{{0.06, 220, 40, 20, 0.25, 0.4}, {0.09, 180, 60, 30, 0.3, -0.9}}};
  return f;
}

struct Degrees {
  int p, q;
  bool rational;
};
std::string degreesName(const testing::TestParamInfo<Degrees>& info) {
  const Degrees& d = info.param;
  std::string name("p");
  name.append(std::to_string(d.p)).append("q").append(std::to_string(d.q));
  if (d.rational) name.append("rational");
  return name;
}

class TangentOf : public testing::TestWithParam<Degrees> {};
INSTANTIATE_TEST_SUITE_P(Degrees, TangentOf,
                         testing::Values(Degrees{1, 1, false}, Degrees{2, 2, false}, Degrees{2, 2, true},
                                         Degrees{3, 3, false}, Degrees{3, 3, true}, Degrees{2, 3, true},
                                         Degrees{4, 1, false}, Degrees{4, 4, true}),
                         degreesName);

TEST_P(TangentOf, IsTheDerivativeOfTheForce) {
  const auto [p, q, rational] = GetParam();
  const NurbsPatch patch = curvedPatch(p, q, rational);
  Fabric curved = plainFabric();
  curved.rest_curvature_of_shape = true;
  for (const Fabric& fabric : {plainFabric(), curved, consistentFabric(), unsymmetricLaminate()})
    EXPECT_LT(tangentError(garmentOf({patch}, {}, fabric, turnedWeft())), 1e-8);
}

TEST_P(TangentOf, GoesThroughSeams) {
  const auto [p, q, rational] = GetParam();
  if (p + q > 6) return;
  EXPECT_LT(tangentError(fourPatches(p, q, rational, SeamKind::C0, 0.4, plainFabric())), 1e-8) << "springs";
  if (p > 1 && q > 1) {
    EXPECT_LT(tangentError(fourPatches(p, q, rational, SeamKind::G1, 0, unsymmetricLaminate())), 1e-8) << "through T";
  }
}

/// The penalty of a weak seam is part of the sheet: force, energy and tangent.
TEST(Tangent, HoldsWeakSeams) {
  const auto [left, right] = cutU(curvedPatch(2, 2, false), 0.55);
  const NurbsPatch finer = insertKnot(right, Direction::v, 0.7);
  for (SeamKind kind : {SeamKind::C0, SeamKind::G1}) {
    Garment g = garmentOf({left, finer}, {}, plainFabric());
    g.weak_seams = {{{0, Side::u1}, {1, Side::u0}, kind, 0.3, 10}};
    EXPECT_LT(tangentError(g), 1e-8);
    const WeakPoints points = buildWeakSeams(g);
    const FreeMap map = buildFreeMap(g);
    const std::vector<Vec3> q = controlsOf(map, deformedFree(g, map, 0.02));
    double energy;
    const auto f = forceOn(Shell(g, widestKernels()), q, &energy, {false, false, true, false});
    std::vector<Vec3> alone(q.size());
    EXPECT_NEAR(energy, addWeakForce(points, q, alone), 1e-12 * energy);
    for (std::size_t i = 0; i < q.size(); ++i) EXPECT_LE(norm(f[i] - alone[i]), 1e-12 * (1 + norm(f[i])));
  }
}

/// The moment of eq. 2.14 has kinks in its slope at kr and k0: the state keeps all points on one branch.
TEST(Tangent, FollowsEquation214OnEachBranch) {
  const NurbsPatch patch = curvedPatch(2, 2, true);
  for (const auto& [kr, k0] : {std::pair{50.0, 60.0}, std::pair{1e-9, 2e-9}, std::pair{1e-9, 50.0}}) {
    Fabric fabric = plainFabric(Bends::zheng);
    zheng(fabric).kappa_regular_per_m = kr;
    zheng(fabric).kappa0_per_m = k0;
    Options o;
    o.step = 1e-5;
    EXPECT_LT(tangentError(garmentOf({patch}, {}, fabric, turnedWeft()), o), 1e-7) << kr << " " << k0;
  }
}

TEST(Tangent, TakesTheSameTermsAsTheForce) {
  const Garment g = fourPatches(2, 2, false, SeamKind::C0, 0.4, plainFabric(Bends::zheng));
  for (const ForceTerms& terms : {ForceTerms{true, false, false, false}, ForceTerms{false, true, false, true},
                                  ForceTerms{false, false, true, false}, ForceTerms{true, true, true, true}}) {
    Options o;
    o.terms = terms;
    EXPECT_LT(tangentError(g, o), 1e-8);
  }
}

/// Wrinkled, slack and taut points side by side; differences across a switch of state are only first order.
TEST(Tangent, FollowsTheTensionField) {
  for (bool laminated : {false, true}) {
    Fabric fabric = plainFabric();
    if (laminated) fabric.law = Laminate{{{0.05, 220, 40, 20, 0.25, 0.6}}};
    fabric.tension_field = true;
    Garment g = garmentOf({flatPatch(uniformKnots(2, 2), uniformKnots(2, 2), 1, 1, 0.2)}, {}, fabric, turnedWeft());
    Options o;
    o.size = 0.05;
    o.step = 1e-7;
    EXPECT_LT(tangentError(g, o), 1e-5) << laminated;
  }
}

TEST(Tangent, CutCellsAndFields) {
  const NurbsPatch patch = curvedPatch(2, 3, true);
  for (const Fabric& fabric : {plainFabric(), unsymmetricLaminate()}) {
    Garment g = garmentOf({patch}, {}, fabric, turnedWeft());
    g.trims.resize(1);
    g.trims[0].loops = {{circle({0.5, 0.45}, 0.22, 0.3, true)}};
    EXPECT_LT(tangentError(g), 1e-8) << "trimmed";
    g.fields.resize(1);
    g.fields[0].thickness = PatchField{1, 2, 2, {0.5, 1, 1.5, 2}};
    g.fields[0].fibre_angle = PatchField{1, 2, 2, {0, 0.5, -0.7, 1}};
    EXPECT_LT(tangentError(g), 1e-8) << "trimmed, with fields";
    g.trims.clear();
    EXPECT_LT(tangentError(g), 1e-8) << "fields";
  }
}

TEST(Tangent, MaterialsOfDifferentLawsSideBySide) {
  Fabric cloth = plainFabric(Bends::zheng);
  zheng(cloth).kappa_regular_per_m = 50;
  zheng(cloth).kappa0_per_m = 60;
  Garment g = garmentOf({curvedPatch(2, 2, false)}, {}, cloth, turnedWeft());
  g.other_fabrics = {unsymmetricLaminate(), consistentFabric()};
  g.fields.resize(1);
  g.fields[0].material = PatchField{0, 3, 1, {0, 1, 2}};
  EXPECT_LT(tangentError(g), 1e-8);
}

TEST(Tangent, EveryInstructionSetGivesTheSame) {
  Garment g = garmentOf({curvedPatch(2, 2, true), curvedPatch(3, 2, false)}, {}, unsymmetricLaminate(), turnedWeft());
  g.trims.resize(2);
  g.trims[0].loops = {{circle({0.5, 0.45}, 0.22, 0.3, true)}};
  const FreeMap map = buildFreeMap(g);
  const std::vector<Vec3> q = controlsOf(map, deformedFree(g, map, 0.02));
  std::vector<double> reference;
  for (const KernelSet* kernels : availableKernels()) {
    const Shell shell(g, *kernels);
    ClothWork work;
    BlockMatrix K;
    Tangent(shell, map).assemble(shell, q, work, K);
    if (reference.empty()) reference.assign(K.values.begin(), K.values.end());
    double most = 0;
    for (double v : reference) most = std::max(most, std::abs(v));
    for (std::size_t i = 0; i < reference.size(); ++i)
      ASSERT_NEAR(K.values[i], reference[i], 1e-12 * most) << kernels->name;
  }
}

/// At rest, curved, free of stress: six rigid modes cost nothing (St. Venant-Kirchhoff, bending from the rest shape).
TEST(Tangent, RigidMotionCostsNothingAtRest) {
  for (const Fabric& fabric : {consistentFabric(), unsymmetricLaminate()}) {
    const Garment g = fourPatches(2, 3, true, SeamKind::C0, 0.4, fabric);
    const FreeMap map = buildFreeMap(g);
    const Shell shell(g, widestKernels());
    ClothWork work;
    BlockMatrix K;
    Tangent(shell, map).assemble(shell, restPoints(g), work, K);
    const auto full = dense(K);
    const std::vector<Vec3> p = deformedFree(g, map, 0);
    for (int mode = 0; mode < 6; ++mode) {
      std::vector<double> u;
      for (const Vec3& x : p) {
        Vec3 e{};
        e[mode % 3] = 1;
        const Vec3 v = mode < 3 ? e : cross(e, x);
        u.insert(u.end(), {v.x, v.y, v.z});
      }
      for (std::size_t r = 0; r < full.size(); ++r) {
        double sum = 0;
        for (std::size_t c = 0; c < u.size(); ++c) sum += full[r][c] * u[c];
        EXPECT_NEAR(sum, 0, 1e-11 * largest(full)) << mode;
      }
    }
    for (std::size_t r = 0; r < full.size(); ++r) EXPECT_GT(full[r][r], 0);
  }
}

/// Diagonal blocks are held whole: their symmetry is not by construction.
TEST(Tangent, DiagonalBlocksAreSymmetric) {
  const Garment g = fourPatches(2, 2, true, SeamKind::C0, 0.4, unsymmetricLaminate());
  const FreeMap map = buildFreeMap(g);
  const Shell shell(g, widestKernels());
  ClothWork work;
  BlockMatrix K;
  Tangent(shell, map).assemble(shell, controlsOf(map, deformedFree(g, map, 0.05)), work, K);
  const double most = largest(dense(K));
  for (int r = 0; r < K.rows(); ++r) {
    const double* b = &K.values[9 * K.find(r, r)];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < i; ++j) EXPECT_NEAR(b[3 * i + j], b[3 * j + i], 1e-13 * most);
  }
}

TEST(Tangent, TheSameBitsForOneAndTwoThreads) {
  const auto wave = [](double a, double b) { return Vec3{a, b, 0.1 * std::sin(5 * a) * b}; };
  const NurbsPatch left = patchOf(uniformKnots(2, 19), uniformKnots(2, 21), wave);
  NurbsPatch right =
      patchOf(uniformKnots(3, 13), uniformKnots(2, 21), [&](double a, double b) { return wave(1 + a, b); });
  const Garment g =
      garmentOf({left, right}, {{{0, Side::u1}, {1, Side::u0}, SeamKind::C0, 0.5}}, plainFabric(Bends::zheng));
  const FreeMap map = buildFreeMap(g);
  const std::vector<Vec3> q = controlsOf(map, deformedFree(g, map, 0.01));
  const Shell shell(g, widestKernels());
  const Tangent tangent(shell, map);
  const int threads = omp_get_max_threads();
  BlockMatrix K[2];
  for (int n : {1, 2}) {
    omp_set_num_threads(n);
    ClothWork work;
    tangent.assemble(shell, q, work, K[n - 1]);
  }
  omp_set_num_threads(threads);
  EXPECT_EQ(std::memcmp(K[0].values.data(), K[1].values.data(), K[0].values.size() * sizeof(double)), 0);
}

TEST(BlockMatrix, FindsAndAddsAlsoBelowTheDiagonal) {
  BlockMatrix K;
  K.offsets = {0, 2, 3};
  K.columns = {0, 1, 1};
  K.values.assign(27, 0.0);
  EXPECT_EQ(K.find(0, 1), 1);
  EXPECT_EQ(K.find(1, 1), 2);
  K.add(1, 0, {1, 2, 3, 4, 5, 6, 7, 8, 9});
  K.add(0, 1, {1, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_EQ(K.values[9], 2);
  EXPECT_EQ(K.values[9 + 1], 4);
  EXPECT_EQ(K.values[9 + 3], 2);
}

}  // namespace
}  // namespace gambeson
