#include "core/yarn/cell_energy.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

#include "core/cloth/shell/tangent.hpp"
#include "core/error.hpp"
#include "core/material/linearised.hpp"
#include "core/material/table/law_table.hpp"
#include "core/yarn/homogenise.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// A balanced plain weave of spacing 1.
RodCellDesign plain(int pieces) {
  RodCellDesign d;
  d.yarns = {plainWeave(), {WovenYarn{1, 0.16, 0.24, 0.16}, WovenYarn{1, 0.16, 0.24, 0.16}}};
  d.section = {RodSection{10, 0.5, 0.4, 0.01, 0.03, 0.05}, RodSection{10, 0.5, 0.4, 0.01, 0.03, 0.05}};
  d.compression = {0.1, 3};
  d.pieces_per_spacing = pieces;
  return d;
}

const CellEnergy& cells() {
  static const CellEnergy energy(plain(8));
  return energy;
}

double resultantOf(const SheetAnswer& a, std::size_t i) { return i < 3 ? a.resultant[i] : a.moment[i - 3]; }

/// A19: 1e-5.
TEST(CellEnergy, SlopesAreDifferencesOfResultantsAndTheseOfTheEnergy) {
  const SheetStrain at{{0.06, 0.045, 0.1}, {0.04, -0.025, 0.03}};
  const SheetAnswer here = cells().at(at);
  const double step[6] = {1e-5, 1e-5, 1e-5, 1e-4, 1e-4, 1e-4};
  double force = 0, stiffest = 0, worst_force = 0, worst_slope = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    force = std::max(force, std::abs(resultantOf(here, i)) * step[i]);
    for (std::size_t j = 0; j < 6; ++j)
      stiffest = std::max(stiffest, std::abs(here.slope[6 * i + j]) * step[i] * step[j]);
  }
  for (std::size_t j = 0; j < 6; ++j) {
    std::array<SheetAnswer, 2> a;
    for (std::size_t k = 0; k < 2; ++k) {
      SheetStrain moved = at;
      (j < 3 ? moved.strain[j] : moved.curvature[j - 3]) += k == 0 ? -step[j] : step[j];
      a[k] = cells().at(moved, SheetParts::resultants);
    }
    worst_force = std::max(
        worst_force, std::abs(0.5 * (a[1].energy_J_per_m2 - a[0].energy_J_per_m2) - resultantOf(here, j) * step[j]));
    for (std::size_t i = 0; i < 6; ++i)
      worst_slope = std::max(worst_slope, std::abs(0.5 * (resultantOf(a[1], i) - resultantOf(a[0], i)) * step[i] -
                                                   here.slope[6 * i + j] * step[i] * step[j]));
  }
  EXPECT_LT(worst_force, 1e-5 * force);
  EXPECT_LT(worst_slope, 1e-5 * stiffest);
}

TEST(CellEnergy, AnswersDoNotDependOnWhatIsRememberedWhereTheEquilibriumIsTheSame) {
  const SheetStrain first{{0.03, 0.02, 0.05}, {}}, second{{0.04, 0.03, 0.02}, {}};
  std::vector<double> none(cells().historySize()), remembered(none.size());
  std::array<SheetAnswer, 2> a;
  cells().evaluate({&first, 1}, SheetParts::resultants, none, remembered, {&a[0], 1});
  cells().evaluate({&second, 1}, SheetParts::resultants, remembered, {}, {&a[0], 1});
  a[1] = cells().at(second, SheetParts::resultants);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(a[0].resultant[i], a[1].resultant[i], 1e-7 * std::abs(a[1].resultant[0]));
  EXPECT_NEAR(remembered[1], 0.03, 0) << "the strain of the committed state";
}

TEST(CellEnergy, WhatFindsNoAnswerHasNone) {
  const SheetAnswer a = cells().at({{-0.6, 0, 0}, {}});
  EXPECT_TRUE(std::isnan(a.energy_J_per_m2));
  EXPECT_TRUE(std::isnan(a.slope[0]));
  EXPECT_THROW(static_cast<void>(cells().steepest()), RunError);
  RodCellDesign held = plain(8);
  held.faces = FaceSupport::held;
  EXPECT_THROW(CellEnergy{held}, InputError);
}

/// A19, on eight points: the same sheet by cells and by the table made from them, within 1 %.
TEST(CellEnergy, ASheetOfCellsAnswersAsItsTable) {
  HomogeniseOptions options;
  options.range = {{{0, 0.08}, {0, 0.08}, {-0.3, 0.3}}};
  options.first_nodes = {4, 4, 4};
  options.tension_error = 0.01, options.shear_error = 0.03;  // of the largest in the range
  options.rigidity_by_strain = false;
  Fabric fabric;
  fabric.thickness_m = 0.5;
  const auto energy = std::make_shared<const CellEnergy>(plain(12));
  const Fabric of_cells = withEnergy(fabric, energy);
  const Fabric of_table =
      withEnergy(fabric, std::make_shared<const LawTable>(homogenise(energy->cell(), options).table));
  std::vector<std::vector<Vec3>> force;
  std::vector<double> stored;
  for (const Fabric& f : {of_cells, of_table}) {
    const Garment g = garmentOf({flatPatch(uniformKnots(2, 2), uniformKnots(2, 1), 20, 10)}, {}, f);
    const Shell shell(g, widestKernels());
    std::vector<Vec3> q = restPoints(g);
    for (Vec3& x : q) x = {1.05 * x.x + 0.1 * x.y, 1.05 * x.y + 5e-4 * x.x * x.y, 2e-3 * x.x * x.x};
    force.push_back(forceOn(shell, q, &stored.emplace_back()));
  }
  double largest = 0;
  for (const Vec3& f : force[1]) largest = std::max(largest, norm(f));
  for (std::size_t i = 0; i < force[0].size(); ++i) EXPECT_LT(norm(force[0][i] - force[1][i]), 1e-2 * largest);
  EXPECT_NEAR(stored[0], stored[1], 1e-2 * stored[1]);
}

/// Forces, what is remembered, and the tangent, point by point from a committed history.
TEST(CellEnergy, BitsDoNotDependOnThreads) {
  Fabric fabric;
  fabric.thickness_m = 0.5;
  const Garment g = garmentOf({flatPatch(uniformKnots(2, 3), uniformKnots(2, 1), 30, 10)}, {},
                              withEnergy(fabric, std::make_shared<const CellEnergy>(plain(8))));
  const Shell shell(g, widestKernels());
  const FreeMap map = buildFreeMap(g);
  const Tangent tangent(shell, map);
  const auto run = [&](int threads) {
    omp_set_num_threads(threads);
    std::vector<double> history(shell.memory().doubles()), next(history.size()), all;
    ClothWork work;
    ClothEnergy energy;
    for (const double stretch : {1.03, 1.05}) {
      std::vector<Vec3> q = restPoints(g), f(q.size());
      for (Vec3& x : q) x = {stretch * x.x + 0.1 * x.y, 1.04 * x.y + 5e-4 * x.x * x.y, 0};
      const ClothState state(q, {}, history);
      shell.force(state, {f, {}, next, &energy}, work, {});
      BlockMatrix K;
      tangent.assemble(shell, state, work, K);
      for (const Vec3& v : f) all.insert(all.end(), {v.x, v.y, v.z});
      all.insert(all.end(), K.values.begin(), K.values.end());
      all.push_back(energy.stored);
      history = next;
    }
    all.insert(all.end(), history.begin(), history.end());
    return all;
  };
  const int before = omp_get_max_threads();
  const std::vector<double> one = run(1), three = run(3);
  omp_set_num_threads(before);
  ASSERT_EQ(one.size(), three.size());
  EXPECT_EQ(std::memcmp(one.data(), three.data(), one.size() * sizeof(double)), 0);
  EXPECT_TRUE(std::isfinite(one[0]));
}

}  // namespace
}  // namespace gambeson
