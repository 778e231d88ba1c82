#include "analysis/sheet_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace gambeson {
namespace {

/// nx x ny cells of two triangles each, without those for which `hole`.
struct Grid {
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> patch, cell;
  std::vector<Vec3> x;
  int nx;

  Grid(int cells_x, int cells_y, bool (*hole)(int, int)) : nx(cells_x) {
    for (int j = 0; j <= cells_y; ++j)
      for (int i = 0; i <= nx; ++i) x.push_back({0.1 * i, 0.1 * j, 0});
    for (int j = 0; j < cells_y; ++j)
      for (int i = 0; i < nx; ++i) {
        if (hole(i, j)) continue;
        const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
        for (const std::array<int, 3>& t : {std::array{a, b, c}, std::array{a, c, d}}) {
          triangles.push_back(t);
          patch.push_back(i < nx / 2 ? 0 : 1);
          cell.push_back(i + nx * j);
        }
      }
  }
  int at(int i, int j) const { return i + (nx + 1) * j; }
  SheetMesh mesh() const { return {triangles, patch, cell, x}; }
};

bool none(int, int) { return false; }

TEST(SheetCells, CellsAtAFreeEdgeAreLeftOut) {
  const Grid g(4, 5, none);
  const std::vector<char> inner = innerSamples(g.mesh());
  for (int j = 0; j <= 5; ++j)
    for (int i = 0; i <= 4; ++i)
      EXPECT_EQ(inner[g.at(i, j)], i >= 1 && i <= 3 && j >= 1 && j <= 4) << i << " " << j;  // the seam at i = 2 is none
}

TEST(SheetCells, ANarrowStrapHasNoInside) {
  const Grid g(2, 6, none);
  const std::vector<char> inner = innerSamples(g.mesh());
  EXPECT_EQ(std::accumulate(inner.begin(), inner.end(), 0), 0);
}

TEST(SheetCells, OneCellAroundAReentrantCornerIsLeftOut) {
  // An L: the upper right quarter is missing, the corner stands at (2, 2).
  const Grid g(4, 4, [](int i, int j) { return i >= 2 && j >= 2; });
  const std::vector<char> clear = clearOfCorners(g.mesh(), 1.125 * std::numbers::pi);
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 4; ++i) {
      if (i > 2 && j > 2) continue;
      EXPECT_EQ(clear[g.at(i, j)], !(i >= 1 && i <= 3 && j >= 1 && j <= 3)) << i << " " << j;
    }
  // Convex corners and straight borders are none, nor is the corner where one asks for sharper ones.
  const Grid whole(4, 4, none);
  const std::vector<char> all = clearOfCorners(whole.mesh(), 1.125 * std::numbers::pi);
  EXPECT_EQ(std::accumulate(all.begin(), all.end(), 0), 25);
  const std::vector<char> sharp = clearOfCorners(g.mesh(), 1.6 * std::numbers::pi);
  EXPECT_EQ(sharp[g.at(2, 2)], 1);
}

TEST(SheetCells, MeanSquaresCountArea) {
  const std::vector<int> region{0, 0, 1};
  const std::vector<double> area{3, 1, 2}, x{1, -3, 5};
  const std::vector<double> r = regionRms(region, area, x, 3);
  EXPECT_DOUBLE_EQ(r[0], std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(r[1], 5);
  EXPECT_DOUBLE_EQ(r[2], 0);
  EXPECT_THROW(regionRms(region, area, std::vector<double>{1}, 1), std::logic_error);
}

}  // namespace
}  // namespace gambeson
