// Cells of a garment and their quadrature.
#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/areas.hpp"

#include <gtest/gtest.h>

#include "core/cloth/patches/surface.hpp"
#include "core/error.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

TEST(Cells, WholeCellsInOrder) {
  const Garment g = garmentOf({curvedPatch(3, 2, true), curvedPatch(2, 2, false)}, {}, plainFabric());
  const auto cells = sheetCells(g);
  ASSERT_EQ(cells.size(), 12u);  // 3 x 2 each
  EXPECT_EQ(cells[0].patch, 0);
  EXPECT_EQ(cells[6].patch, 1);
  EXPECT_EQ(cells[1].su, 4);  // u is fastest; knots 0 0 0 0 0.3 0.55 1
  EXPECT_EQ(cells[1].u0, 0.3);
  EXPECT_EQ(cells[3].sv, 3);  // knots 0 0 0 0.4 1
  EXPECT_EQ(cells[3].v1, 1);
}

TEST(Cells, RuleIsExactForItsDegree) {
  const Garment g = garmentOf({curvedPatch(3, 2, false)}, {}, plainFabric());
  double sum = 0;  // of u^5 v^3 over the unit square: 1/6 1/4
  for (const SheetCell& cell : sheetCells(g))
    for (const CellPoint& point : cellRule(cell, 3, 2))
      sum += std::pow(point.u, 5) * std::pow(point.v, 3) * point.weight;
  EXPECT_NEAR(sum, 1.0 / 24, 1e-15);
}

TEST(Cells, CutCellKeepsItsOwnRule) {
  SheetCell cell;
  cell.u1 = cell.v1 = 1;
  cell.cut = true;
  cell.points = {{0.25, 0.5, 0.125}};
  const auto rule = cellRule(cell, 3, 3);
  ASSERT_EQ(rule.size(), 1u);
  EXPECT_EQ(rule[0].weight, 0.125);
}

TEST(Cells, TrimmedPatches) {
  // The second of two unit squares loses a circle: the cell inside it is left out, area 2 - pi/16; a bad loop is named
  // with its patch.
  const NurbsPatch square = flatPatch(uniformKnots(2, 5), uniformKnots(2, 5), 1, 1);
  Garment g = garmentOf({square, square}, {}, plainFabric());
  g.trims.resize(2);
  g.trims[1].loops = {{circle({0.5, 0.5}, 0.25, 0.25, true)}};
  g.trims[1].points_per_piece = 10;
  const auto cells = sheetCells(g);
  EXPECT_EQ(cells.size(), 25u + 24u);
  double area = 0;
  for (const SheetCell& cell : cells) {
    EXPECT_TRUE(!cell.cut || cell.patch == 1);
    for (const CellPoint& point : cellRule(cell, 3, 3)) area += point.weight;
  }
  EXPECT_NEAR(area, 2 - kPi / 16, 1e-10);
  double control = 0;
  for (double a : controlAreas(g)) control += a;
  EXPECT_NEAR(control, 2 - kPi / 16, 1e-10);
  g.trims[1].loops = {{circle({0.5, 0.9}, 0.25, 0.25, true)}};
  try {
    sheetCells(g);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "trims[1].loops[0].curves[0]");
  }
}

TEST(Cells, TrimsMatchPatches) {
  Garment g = garmentOf({curvedPatch(2, 2, false)}, {}, plainFabric());
  g.trims.resize(2);
  EXPECT_THROW(sheetCells(g), InputError);
}

}  // namespace
}  // namespace gambeson
