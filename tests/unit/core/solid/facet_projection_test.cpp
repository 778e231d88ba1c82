/// Gap and local coordinates of a node over a twisted facet, against differences.

#include "core/solid/facet_projection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gambeson {
namespace {

/// A node at some depth over a twisted facet.
struct Place {
  FacetCorners corners{{{0, 0, 0}, {1, 0.1, 0.2}, {1.2, 1, -0.1}, {-0.1, 0.9, 0.3}}};
  Vec3 node;
  explicit Place(std::mt19937& random) {
    std::uniform_real_distribution<double> d(-1.2, 1.2), depth(-0.1, 0.1);
    const Vec2 at{d(random), d(random)};
    node = facetPosition(corners, at) + depth(random) * facetNormal(corners, at);
  }
  double& z(int i) { return i < 3 ? node[i] : corners[(i - 3) / 3][i % 3]; }
  FacetProjection projection() const { return projectionOf(corners, node, *projectOnFacet(corners, node, 2)); }
};

/// f(z + way h e_i) for the difference of fourth order.
template <class F>
auto slopeOf(Place place, int i, const F& f) {
  const double h = 1e-4, at = place.z(i);
  const auto moved = [&](double way) {
    place.z(i) = at + way * h;
    return f(place.projection());
  };
  return (8 * (moved(1) - moved(-1)) - (moved(2) - moved(-2))) / (12 * h);
}

TEST(FacetProjection, SlopesAreDerivatives) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 20; ++trial) {
    const Place place(random);
    const FacetProjection p = place.projection();
    for (int i = 0; i < kProjectionSize; ++i) {
      EXPECT_NEAR(slopeOf(place, i, [](const FacetProjection& q) { return q.gap_m; }), p.gap_slope[i], 1e-9);
      EXPECT_NEAR(slopeOf(place, i, [](const FacetProjection& q) { return q.local.x; }), p.local_slope[0][i], 1e-8);
      EXPECT_NEAR(slopeOf(place, i, [](const FacetProjection& q) { return q.local.y; }), p.local_slope[1][i], 1e-8);
    }
  }
}

TEST(FacetProjection, CurvaturesAreDerivativesOfSlopesAndSymmetric) {
  std::mt19937 random(2);
  const Vec2 factor{0.7, -1.3};
  for (int trial = 0; trial < 20; ++trial) {
    const Place place(random);
    const FacetProjection p = place.projection();
    ProjectionMatrix gap{}, local{};
    addGapCurvature(place.corners, place.node, p, 1, gap);
    addLocalCurvature(place.corners, place.node, p, factor, local);
    double most = 0;
    for (int k = 0; k < 225; ++k) most = std::max({most, std::abs(gap[k]), std::abs(local[k])});
    for (int i = 0; i < kProjectionSize; ++i)
      for (int j = 0; j < kProjectionSize; ++j) {
        EXPECT_NEAR(gap[15 * i + j], gap[15 * j + i], 1e-12 * most);
        EXPECT_NEAR(local[15 * i + j], local[15 * j + i], 1e-12 * most);
        EXPECT_NEAR(slopeOf(place, i, [&](const FacetProjection& q) { return q.gap_slope[j]; }), gap[15 * i + j],
                    1e-7 * most);
        EXPECT_NEAR(slopeOf(place, i,
                            [&](const FacetProjection& q) {
                              return factor.x * q.local_slope[0][j] + factor.y * q.local_slope[1][j];
                            }),
                    local[15 * i + j], 1e-7 * most);
      }
  }
}

TEST(FacetProjection, ARigidMotionChangesNothing) {
  std::mt19937 random(3);
  const FacetProjection p = Place(random).projection();
  for (const ProjectionSlope& s : {p.gap_slope, p.local_slope[0], p.local_slope[1]})
    for (int c = 0; c < 3; ++c) {
      double sum = 0;
      for (int k = 0; k < 5; ++k) sum += s[3 * k + c];
      EXPECT_NEAR(sum, 0, 1e-14);
    }
}

}  // namespace
}  // namespace gambeson
