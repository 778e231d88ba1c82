#include "core/contact/four_pairs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/contact/segment_pair.hpp"
#include "core/contact/triangle.hpp"

namespace gambeson {
namespace {

/// Random pairs, some of them degenerate, whose corners move; distances in double precision from closestOnTriangle and
/// nearestOnSegments.
struct FourPairs : testing::Test {
  std::mt19937 random{5};
  std::normal_distribution<double> normal;
  std::array<std::array<Vec3, 4>, 4> now, then;
  std::vector<MovingPoint> points;
  std::array<std::array<int, 4>, 4> vertex;

  Vec3 any(double size) { return {size * normal(random), size * normal(random), size * normal(random)}; }
  static Four single(const Vec3& v) {
    return Four{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0};
  }
  void place() {
    points.clear();
    for (int k = 0; k < 4; ++k)
      for (int c = 0; c < 4; ++c) {
        now[k][c] = any(0.01);
        if (c > 0 && random() % 8 == 0) now[k][c] = now[k][c - 1];                        // no length, no area
        if (c > 2 && random() % 8 == 0) now[k][c] = now[k][2] + (now[k][1] - now[k][0]);  // parallel
        then[k][c] = now[k][c] + any(0.001);
        vertex[k][c] = static_cast<int>(points.size());
        points.push_back({single(now[k][c]), single(then[k][c])});
      }
  }
  std::array<Vec3, 4> between(int k, double s) const {
    std::array<Vec3, 4> x;
    for (int c = 0; c < 4; ++c) x[c] = (1 - s) * now[k][c] + s * then[k][c];
    return x;
  }
};

double ofPoint(const std::array<Vec3, 4>& x) { return std::sqrt(closestOnTriangle({x[1], x[2], x[3]}, x[0]).dist2_m2); }
double ofEdges(const std::array<Vec3, 4>& x) { return std::sqrt(nearestOnSegments(x[0], x[1], x[2], x[3]).dist2_m2); }

/// The gap at first is the distance, as its direction is that of the nearest points; the chord of the gaps is never
/// above the distance on the way.
TEST_F(FourPairs, GapsAreTheDistanceAtFirstAndNeverMoreLater) {
  constexpr double rounding = 1e-7;
  int tight[2] = {0, 0}, all[2] = {0, 0};
  for (int trial = 0; trial < 2000; ++trial) {
    place();
    for (int kind = 0; kind < 2; ++kind) {
      const FourGaps gaps = kind ? gapsOf<2>(points, vertex) : gapsOf<1>(points, vertex);
      for (int k = 0; k < 4; ++k) {
        const auto distance = [&](double s) { return kind ? ofEdges(between(k, s)) : ofPoint(between(k, s)); };
        for (double s : {0.0, 0.25, 0.5, 0.75, 1.0})
          ASSERT_LE((1 - s) * gaps.now[k] + s * gaps.then[k], distance(s) + rounding) << kind << " " << trial;
        if (distance(0) < 1e-4) continue;
        ++all[kind];
        tight[kind] += gaps.now[k] > 0.999 * distance(0) - rounding;
      }
    }
  }
  // All points; edges that are nearly parallel may take other points for the nearest.
  EXPECT_EQ(tight[0], all[0]);
  EXPECT_GT(tight[1], 0.995 * all[1]);
  EXPECT_GT(std::min(all[0], all[1]), 5000);
}

/// Corners of one tile beyond another along any direction, on the way too.
TEST_F(FourPairs, TilesAreNoFartherApartThanTheirCorners) {
  int apart = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    place();
    const auto shape = [&](int k, bool two) {
      const auto& v = vertex[k];
      return TileShape(points[v[0]], points[v[1]], points[v[2]], points[two ? v[3] : v[2]], two);
    };
    const TileShape a = shape(0, trial % 2), b = shape(1, trial % 3);
    const Four way = a.centre - b.centre;
    for (const Four& n : {TileShape::unit(way), a.normal, b.normal}) {
      EXPECT_LT(TileShape::dot(n, n), 1 + 1e-6);
      const Four gap = beyond(a, b, n);
      for (int i = 0; i < (trial % 2 ? 4 : 3); ++i)
        for (int j = 0; j < (trial % 3 ? 4 : 3); ++j)
          for (double s : {0.0, 0.5, 1.0}) {
            ASSERT_LE(gap[i], norm(between(0, s)[i] - between(1, s)[j]) + 1e-7);
            apart += gap[i] > 0;
          }
    }
  }
  EXPECT_GT(apart, 1000);
}

/// A flat cell and a triangle above it: the height, whichever normal tells.
TEST(Tile, NormalsAreThoseOfItsTriangles) {
  const auto at = [](float x, float y, float z) { return MovingPoint{Four{x, y, z, 0}, Four{x, y, z + 1, 0}}; };
  const TileShape cell(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0), true);
  const TileShape triangle(at(0, 0, 3), at(1, 0, 3), at(0, 1, 3), at(0, 1, 3), false);
  for (const TileShape& t : {cell, triangle}) EXPECT_EQ(std::abs(t.normal[2]), 1.0f);
  const Four gap = beyond(triangle, cell, Four{0, 0, 1, 0});
  for (int k = 0; k < 4; ++k) EXPECT_EQ(gap[k], 3.0f);
  EXPECT_EQ(leastOf(Four{4, 2, 3, 5})[1], 2.0f);
  EXPECT_EQ(mostOf(Four{4, 2, 3, 5})[2], 5.0f);
}

}  // namespace
}  // namespace gambeson
