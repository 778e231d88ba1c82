// Cells whose law is an energy at a point: the kernels' forces where the law is theirs, derivatives, closed loops.
#include "core/cloth/shell/point_cells.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstring>

#include "core/cloth/shell/tangent.hpp"
#include "core/error.hpp"
#include "core/material/linearised.hpp"
#include "core/material/table/law_table.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"
#include "unit/core/material/table/stiffening_cloth.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// The fabric with a table of its own law.
Fabric tabulated(const Fabric& fabric) {
  const Section s = pointLaw(fabric).section;
  return withEnergy(fabric, std::make_shared<const LawTable>(
                                linearTable({s.A[0], s.A[1], s.A[2]}, s.A[3], {s.D[0], s.D[1], s.D[2]}, s.D[3])));
}

Fabric stiffening() {
  Fabric f = plainFabric();
  f.jam_area = 0;
  return withEnergy(f, std::make_shared<const LawTable>(tableOf({}, 7, 4)));
}

struct Answer {
  std::vector<Vec3> force;
  double energy = 0;
  BlockMatrix K;
};

Answer answerOf(const Garment& g, const std::vector<Vec3>& p, const ForceTerms& terms = {}) {
  const Shell shell(g, widestKernels());
  const FreeMap map = buildFreeMap(g);
  Answer a;
  ClothWork work;
  const std::vector<Vec3> q = controlsOf(map, p);
  a.force = forceOn(shell, q, &a.energy, terms);
  Tangent(shell, map).assemble(shell, q, work, a.K, terms);
  return a;
}

double largestOf(const std::vector<Vec3>& f) {
  double most = 0;
  for (const Vec3& v : f) most = std::max(most, norm(v));
  return most;
}

void expectSame(const Answer& a, const Answer& b, double part) {
  EXPECT_NEAR(a.energy, b.energy, part * std::abs(b.energy));
  const double force = largestOf(b.force);
  for (std::size_t i = 0; i < a.force.size(); ++i) EXPECT_LT(norm(a.force[i] - b.force[i]), part * force);
  double largest = 0, worst = 0;
  ASSERT_EQ(a.K.values.size(), b.K.values.size());
  for (std::size_t k = 0; k < a.K.values.size(); ++k) {
    largest = std::max(largest, std::abs(b.K.values[k]));
    worst = std::max(worst, std::abs(a.K.values[k] - b.K.values[k]));
  }
  EXPECT_LT(worst, part * largest);
}

std::vector<Vec3> strained(const Garment& g, double size) { return deformedFree(g, buildFreeMap(g), size); }

TEST(PointCells, ATableOfTheKernelsLawAnswersAsTheKernels) {
  Fabric curved = plainFabric();
  curved.rest_curvature_of_shape = true;
  for (const Fabric& fabric : {plainFabric(), curved})
    for (const bool rational : {false, true})
      for (const int degree : {2, 3}) {
        const NurbsPatch patch = curvedPatch(degree, 2, rational);
        const Garment with = garmentOf({patch}, {}, fabric, turnedWeft());
        const Garment table = garmentOf({patch}, {}, tabulated(fabric), turnedWeft());
        const std::vector<Vec3> p = strained(with, 0.01);
        ForceTerms membrane, bending, definite;
        membrane.bending = bending.membrane = false;
        definite.definite = true;
        for (const ForceTerms& terms : {ForceTerms{}, membrane, bending, definite})
          expectSame(answerOf(table, p, terms), answerOf(with, p, terms), 1e-10);
      }
}

TEST(PointCells, CutCellsAndSeamsAreAsTheKernelsHaveThem) {
  Garment trimmed = garmentOf({unitPatch(2, 5)}, {}, plainFabric(), turnedWeft());
  trimmed.trims = {{{{circle({0.52, 0.5}, 0.35, 0.4, false)}}, 0}};
  Garment sewn = fourPatches(2, 2, false, SeamKind::C0, 0.4, plainFabric());
  for (const Garment& with : {trimmed, sewn}) {
    Garment table = with;
    table.fabric = tabulated(with.fabric);
    const std::vector<Vec3> p = strained(with, 0.005);
    expectSame(answerOf(table, p), answerOf(with, p), 1e-10);
  }
}

TEST(PointCells, OnePatchOfATableStandsBesideOthers) {
  Garment with = fourPatches(2, 2, false, SeamKind::C0, 0.4, plainFabric());
  Garment table = with;
  table.other_fabrics = {tabulated(with.fabric)};
  table.fields.resize(4);
  table.fields[2].material = PatchField{0, 1, 1, {1}};
  const std::vector<Vec3> p = strained(with, 0.005);
  expectSame(answerOf(table, p), answerOf(with, p), 1e-10);
}

/// A19.
TEST(PointCells, TheForceIsTheEnergysGradientAndTheTangentTheForces) {
  for (const bool rational : {false, true}) {
    const Garment g = garmentOf({curvedPatch(2, 2, rational)}, {}, stiffening(), turnedWeft());
    const Shell shell(g, widestKernels());
    const FreeMap map = buildFreeMap(g);
    std::vector<Vec3> p = strained(g, 0.02);
    const Answer here = answerOf(g, p);
    const double force = largestOf(here.force);
    double stiffest = 0, worst_force = 0, worst_slope = 0;
    for (double k : here.K.values) stiffest = std::max(stiffest, std::abs(k));
    const double h = 1e-5;
    for (std::size_t i = 0; i < p.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        std::array<double, 4> energy{};
        std::array<std::vector<Vec3>, 4> f;
        for (std::size_t k = 0; k < 4; ++k) {
          const double old = p[i][c];
          p[i][c] += h * std::array{-2.0, -1.0, 1.0, 2.0}[k];
          f[k] = onFree(map, forceOn(shell, controlsOf(map, p), &energy[k]));
          p[i][c] = old;
        }
        const auto slope = [&](auto of) { return (8 * (of(2) - of(1)) - (of(3) - of(0))) / (12 * h); };
        worst_force = std::max(
            worst_force, std::abs(slope([&](std::size_t k) { return energy[k]; }) + onFree(map, here.force)[i][c]));
        for (std::size_t j = 0; j < p.size(); ++j) {
          const long at = here.K.find(static_cast<int>(std::min(i, j)), static_cast<int>(std::max(i, j)));
          for (int d = 0; d < 3; ++d) {
            const double exact = at < 0   ? 0
                                 : j <= i ? here.K.values[static_cast<std::size_t>(9 * at + 3 * d + c)]
                                          : here.K.values[static_cast<std::size_t>(9 * at + 3 * c + d)];
            worst_slope = std::max(worst_slope, std::abs(slope([&](std::size_t k) { return f[k][j][d]; }) + exact));
          }
        }
      }
    EXPECT_LT(worst_force, 1e-6 * force);
    EXPECT_LT(worst_slope, 1e-6 * stiffest);
    const LawRange range = shell.lawRange(controlsOf(map, p));
    EXPECT_GT(range.beyond, 0) << "the state has to leave the table at some points";
    EXPECT_LT(range.beyond, range.points);
    EXPECT_EQ(range.points, shell.gaussPoints());
  }
}

/// A19: a closed loop of a small sheet takes no energy.
TEST(PointCells, AClosedLoopTakesNoEnergy) {
  const Garment g = garmentOf({flatPatch(uniformKnots(2, 2), uniformKnots(2, 2), 0.1, 0.1)}, {}, stiffening());
  const Shell shell(g, widestKernels());
  const FreeMap map = buildFreeMap(g);
  const auto corner = [&](double stretch, double shear, double bend, double noise, unsigned seed) {
    std::vector<Vec3> p = deformedFree(g, map, noise, seed);
    for (Vec3& x : p)
      x = {x.x * (1 + stretch) + shear * x.y, x.y * (1 + 0.5 * stretch), x.z + bend * (x.x * x.x - x.x * x.y)};
    return p;
  };
  const std::vector<std::vector<Vec3>> corners{corner(0.01, 0, 0, 0, 1), corner(0.05, 0.1, 3, 2e-4, 2),
                                               corner(0.03, 0.2, -4, 3e-4, 3), corner(0, 0.05, 1, 2e-4, 4),
                                               corner(0.01, 0, 0, 0, 1)};
  constexpr int kSteps = 200;
  double work = 0, size = 0;
  for (std::size_t leg = 0; leg + 1 < corners.size(); ++leg)
    for (int k = 0; k < kSteps; ++k)
      for (const double side : {-0.5, 0.5}) {
        const double t = (k + 0.5 + side / std::sqrt(3.0)) / kSteps;
        std::vector<Vec3> p;
        for (std::size_t i = 0; i < corners[leg].size(); ++i)
          p.push_back((1 - t) * corners[leg][i] + t * corners[leg + 1][i]);
        const std::vector<Vec3> f = onFree(map, forceOn(shell, controlsOf(map, p)));
        double power = 0;
        for (std::size_t i = 0; i < p.size(); ++i) power += dot(f[i], corners[leg + 1][i] - corners[leg][i]);
        work += power / (2 * kSteps);
        size += std::abs(power) / (2 * kSteps);
      }
  EXPECT_LT(std::abs(work), 1e-10 * size);
}

TEST(PointCells, BitsDoNotDependOnThreads) {
  const Garment g = garmentOf({curvedPatch(2, 2, false)}, {}, stiffening(), turnedWeft());
  const std::vector<Vec3> p = strained(g, 0.02);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Answer one = answerOf(g, p);
  omp_set_num_threads(3);
  const Answer three = answerOf(g, p);
  omp_set_num_threads(before);
  EXPECT_EQ(std::memcmp(one.force.data(), three.force.data(), one.force.size() * sizeof(Vec3)), 0);
  EXPECT_EQ(std::memcmp(one.K.values.data(), three.K.values.data(), one.K.values.size() * sizeof(double)), 0);
  EXPECT_EQ(one.energy, three.energy);
}

/// The steepest law is stiffer than the law in any state of the range, for any motion.
TEST(PointCells, TheSteepestLawBoundsTheTangent) {
  const Garment g = garmentOf({flatPatch(uniformKnots(2, 3), uniformKnots(2, 3), 0.3, 0.3)}, {}, stiffening());
  const FreeMap map = buildFreeMap(g);
  ForceTerms steepest;
  steepest.steepest = true;
  std::vector<Vec3> p = deformedFree(g, map, 0);
  const Answer stiff = answerOf(g, p, steepest);
  for (Vec3& x : p) x = {1.05 * x.x, 1.05 * x.y, x.z};
  const Answer now = answerOf(g, p);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> d(-1, 1);
  const auto form = [](const BlockMatrix& K, const std::vector<Vec3>& y) {
    std::vector<double> x, Kx(3 * y.size());
    for (const Vec3& v : y) x.insert(x.end(), {v.x, v.y, 0});  // tension stiffens what lies across
    for (int r = 0; r < K.rows(); ++r)
      for (long k = K.offsets[static_cast<std::size_t>(r)]; k < K.offsets[static_cast<std::size_t>(r) + 1]; ++k)
        for (std::size_t i = 0; i < 9; ++i) {
          const std::size_t row = 3 * static_cast<std::size_t>(r) + i / 3;
          const std::size_t column = 3 * static_cast<std::size_t>(K.columns[static_cast<std::size_t>(k)]) + i % 3;
          const double value = K.values[9 * static_cast<std::size_t>(k) + i];
          Kx[row] += value * x[column];
          if (K.columns[static_cast<std::size_t>(k)] != r) Kx[column] += value * x[row];
        }
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += x[i] * Kx[i];
    return sum;
  };
  for (int k = 0; k < 20; ++k) {
    std::vector<Vec3> y(p.size());
    for (Vec3& v : y) v = {d(random), d(random), 0};
    EXPECT_GT(form(stiff.K, y), form(now.K, y));
  }
}

TEST(PointCells, AssumedStrainsAndVaryingFabricsAreRefused) {
  const auto keyOf = [](auto f) -> std::string {
    try {
      f();
    } catch (const InputError& e) {
      return e.where().key;
    }
    return "taken";
  };
  const Garment g = garmentOf({curvedPatch(2, 2, false)}, {}, stiffening(), turnedWeft());
  EXPECT_EQ(keyOf([&] { Shell(g, widestKernels(), 0, CellRule::assumed); }), "rule");
  Garment thicker = g;
  thicker.fields = {PatchFields{PatchField{1, 2, 2, {1, 2, 1, 2}}, {}, {}}};
  EXPECT_EQ(keyOf([&] { Shell(thicker, widestKernels()); }), "fields[0].thickness");
  Garment mixed = g;
  mixed.other_fabrics = {plainFabric()};
  mixed.fields = {PatchFields{{}, {}, PatchField{0, 2, 1, {0, 1}}}};
  EXPECT_EQ(keyOf([&] { Shell(mixed, widestKernels()); }), "fields[0].material");
  Garment jams = g;
  jams.fabric.jam_area = 0.5;
  EXPECT_EQ(keyOf([&] { Shell(jams, widestKernels()); }), "fabric.jam_area");
}

}  // namespace
}  // namespace gambeson
