/// Positive areas of the samples of what trimming leaves, however narrow against a cell.
#include "core/cloth/patches/sample_areas.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/cloth/draft/areas.hpp"
#include "core/cloth/patches/surface.hpp"
#include "unit/core/cloth/sewn_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr double kStripCell = 0.1;

/// A strip of 7 cells' length that leans on the grid, from one width to another; widths in cells.
Garment leaningStrip(double from, double to, double lean, double shift) {
  Garment g = garmentOf({panelPatch(9, 9, {-0.45, -0.45}, {0.45, 0.45})}, {}, plainFabric());
  std::vector<Vec2> corners{{-0.35, -0.5 * kStripCell * from},
                            {0.35, -0.5 * kStripCell * to},
                            {0.35, 0.5 * kStripCell * to},
                            {-0.35, 0.5 * kStripCell * from}};
  for (Vec2& c : corners)
    c = {c.x * std::cos(lean) - c.y * std::sin(lean), c.x * std::sin(lean) + c.y * std::cos(lean) + shift * kStripCell};
  g.trims.resize(1);
  g.trims[0].loops = {polygon(corners)};
  return g;
}

TEST(SampleAreas, StripsNarrowerThanACellHavePositiveOnes) {
  for (const auto& [from, to] : {std::pair(0.9, 0.9), std::pair(0.5, 0.5), std::pair(0.25, 0.25), std::pair(0.1, 0.1),
                                 std::pair(1.2, 0.05), std::pair(2.5, 0.3)})
    for (const double lean : {0.0, 0.03, 0.3, 0.7})
      for (const double shift : {0.0, 0.23, 0.5}) {
        SCOPED_TRACE(::testing::Message() << from << " to " << to << " cells, leans " << lean << ", shift " << shift);
        const Garment g = leaningStrip(from, to, lean, shift);
        const FreeMap map = buildFreeMap(g);
        Surface s;
        ASSERT_NO_THROW(s = buildSurface(g, map, 2));
        EXPECT_GT(*std::min_element(s.area_m2.begin(), s.area_m2.end()), 0);
        std::vector<double> load(map.home.size()), A(map.home.size());
        s.WTt.multiply<double>(s.area_m2, load);
        map.Tt.multiply<double>(controlAreas(g), A);
        const double most = *std::max_element(A.begin(), A.end());
        for (std::size_t i = 0; i < A.size(); ++i) EXPECT_NEAR(load[i], A[i], 1e-11 * most);
        EXPECT_NEAR(std::accumulate(s.area_m2.begin(), s.area_m2.end(), 0.0), 0.5 * (from + to) * kStripCell * 0.7,
                    1e-9);
      }
}

/// Of samples in [0, 1] under the Bernstein polynomials of degree 2.
SampleAreas bernsteinAreas(const std::vector<double>& at, double near_m2) {
  SparseRows W;
  W.column_count = 3;
  for (const double x : at) {
    W.add(0, (1 - x) * (1 - x)), W.add(1, 2 * x * (1 - x)), W.add(2, x * x);
    W.endRow();
  }
  return positiveAreas(W, std::vector<double>(3, 1.0 / 3), std::vector<double>(at.size(), near_m2));
}

/// Where the search has far to go (138 e-folds from 1e-60), the areas are found all the same; where it is farther than
/// its steps reach (460), it does not say that there are none.
TEST(SampleAreas, WhatWasNotFoundIsNotCalledNone) {
  const std::vector<double> at{0, 0.1, 0.2, 0.6, 1};
  const SampleAreas far = bernsteinAreas(at, 1e-60);
  ASSERT_EQ(far.area_m2.size(), at.size());
  EXPECT_NEAR(std::accumulate(far.area_m2.begin(), far.area_m2.end(), 0.0), 1, 1e-12);
  const SampleAreas farther = bernsteinAreas(at, 1e-200);
  EXPECT_TRUE(farther.area_m2.empty());
  EXPECT_TRUE(farther.undecided);
  const SampleAreas none = bernsteinAreas({0, 0.1, 0.2, 1}, 0.25);
  EXPECT_TRUE(none.area_m2.empty());
  EXPECT_FALSE(none.undecided);
}

/// A quadratic across two samples only: x (1 - x) vanishes at both and has an integral of 1/6.
TEST(SampleAreas, WhatStandsAgainstThemIsAFunctionThatTheSamplesDoNotSee) {
  const auto areas = [](const std::vector<double>& at) { return bernsteinAreas(at, 1.0 / at.size()); };
  // Of three samples the weights of 0.9 and 1 would be of two signs (interpolatory rule at 0, 0.1, 1).
  const SampleAreas none = areas({0, 0.1, 0.2, 1});
  ASSERT_TRUE(none.area_m2.empty());
  ASSERT_EQ(none.against.size(), 3u);
  const auto f = [&](double x) {
    return (1 - x) * (1 - x) * none.against[0] + 2 * x * (1 - x) * none.against[1] + x * x * none.against[2];
  };
  EXPECT_GT(none.against[0] + none.against[1] + none.against[2], 0);
  EXPECT_GT(f(0.6), 1);
  EXPECT_LT(std::max({f(0), f(0.2), f(1)}), f(0.6));
  const SampleAreas some = areas({0, 0.1, 0.2, 0.6, 1});
  ASSERT_EQ(some.area_m2.size(), 5u);
  EXPECT_GT(*std::min_element(some.area_m2.begin(), some.area_m2.end()), 0);
  EXPECT_NEAR(std::accumulate(some.area_m2.begin(), some.area_m2.end(), 0.0), 1, 1e-13);
}

}  // namespace
}  // namespace gambeson
