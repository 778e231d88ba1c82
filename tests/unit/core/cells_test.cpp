// Cells of a garment and their quadrature.
#include "core/sheet/cells.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "sheet_shapes.hpp"

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

TEST(Cells, TrimsMatchPatches) {
  Garment g = garmentOf({curvedPatch(2, 2, false)}, {}, plainFabric());
  g.trims.resize(2);
  EXPECT_THROW(sheetCells(g), InputError);
}

}  // namespace
}  // namespace gambeson
