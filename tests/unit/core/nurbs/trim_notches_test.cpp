/// Notches told as parts of outlines: the same area, and no hole along the border.

#include "core/nurbs/trim_notches.hpp"

#include <gtest/gtest.h>

#include "core/nurbs/trim_arcs.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

TrimLoop loopOf(std::vector<Vec2> corners) { return polygon(corners); }

/// What is kept is the same, point by point and in area; returns the signed areas of the loops.
std::vector<double> expectSame(const NurbsPatch& patch, const Trim& trim) {
  const Trim told = withoutNotches(patch, trim);
  const double u0 = patch.u.front(), du = patch.u.back() - u0, v0 = patch.v.front(), dv = patch.v.back() - v0;
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 60; ++i) {
      const Vec2 p{u0 + du * (i + 0.437) / 60, v0 + dv * (j + 0.519) / 60};
      EXPECT_EQ(isKept(patch, told, p), isKept(patch, trim, p)) << p.x << " " << p.y;
    }
  EXPECT_NEAR(keptArea(patch, told), keptArea(patch, trim), 1e-12);
  return trimBoundary(patch, told).signed_area;
}

TEST(TrimNotches, ANotchBecomesAPartOfTheOutline) {
  const KnotVector one{2, {0, 0, 0, 1, 1, 1}};
  // A neckline of two arcs, with a hole below it.
  const TrimLoop neck{line({0.3, 1}, {0.7, 1}),
                      {one, {{0.7, 1}, {0.7, 0.6}, {0.5, 0.6}}, {1, 1, 1}},
                      {one, {{0.5, 0.6}, {0.3, 0.6}, {0.3, 1}}, {1, 1, 1}}};
  const TrimLoop hole{circle({0.5, 0.3}, 0.1, 0.1, true)};
  const std::vector<double> areas = expectSame(unitPatch(2, 5), {{neck, hole}});
  ASSERT_EQ(areas.size(), 2u);
  EXPECT_LT(areas[0], 0);
  EXPECT_GT(areas[1], 0.8);
}

TEST(TrimNotches, CornersAndNotchesInOneSideOnAnyRectangle) {
  NurbsPatch patch = unitPatch(2, 4);
  for (double& k : patch.u.knots) k = 2 + 3 * k;
  for (double& k : patch.v.knots) k = -1 + 0.5 * k;
  const auto at = [](double s, double t) { return Vec2{2 + 3 * s, -1 + 0.5 * t}; };
  const std::vector<double> areas = expectSame(
      patch, {{loopOf({at(1, 0.8), at(0.7, 1), at(1, 1)}),  // the corner: two lines on the border
               loopOf({at(0.1, 0), at(0.15, 0.3), at(0.3, 0)}), loopOf({at(0.5, 0), at(0.5, 0.2), at(0.6, 0)}),
               loopOf({at(0, 0.4), at(0, 0.6), at(0.2, 0.5)})}});
  ASSERT_EQ(areas.size(), 1u);
  EXPECT_GT(areas[0], 0);
}

TEST(TrimNotches, AStripLeavesTwoOutlines) {
  const std::vector<double> areas = expectSame(
      unitPatch(1, 4), {{loopOf({{0, 0.4}, {0, 0.55}, {1, 0.7}, {1, 0.4}}), loopOf({{0.4, 1}, {0.6, 1}, {0.5, 0.9}})}});
  ASSERT_EQ(areas.size(), 2u);
  for (const double a : areas) EXPECT_GT(a, 0.3);
}

TEST(TrimNotches, WhatHasNoneStays) {
  const NurbsPatch patch = unitPatch(2, 4);
  const Trim hole{{{circle({0.5, 0.5}, 0.2, 0.2, true)}}}, outline{{loopOf({{0, 0}, {1, 0}, {1, 0.5}, {0, 0.5}})}};
  for (const Trim& t : {hole, outline}) {
    const Trim told = withoutNotches(patch, t);
    ASSERT_EQ(told.loops.size(), 1u);
    EXPECT_EQ(told.loops[0].size(), t.loops[0].size());
  }
}

}  // namespace
}  // namespace gambeson
