#include "tryon/pattern/strap.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "human/body/skin.hpp"
#include "human/manikin/manikin.hpp"
#include "human/skin/make_skin.hpp"
#include "tryon/pattern/armour.hpp"
#include "unit/manikins_asked.hpp"

namespace gambeson {
namespace {

constexpr double kWidth_m = 0.0385, kRadius_m = 0.06, kClearance_m = 0.007, kDown_m = 0.08;

/// A round bar for a shoulder, its axis through (0, 0.1, 1.4) and sloping down to the left.
TriangleMesh bar(double slope) {
  const Vec3 axis{0, std::cos(slope), -std::sin(slope)}, up{0, std::sin(slope), std::cos(slope)};
  constexpr int around = 360;
  TriangleMesh m;
  for (const double a : {-0.3, 0.3})
    for (int k = 0; k < around; ++k) {
      const double angle = 2 * M_PI * k / around;
      m.vertices.push_back(Vec3{0, 0.1, 1.4} + a * axis +
                           kRadius_m * (std::cos(angle) * Vec3{1, 0, 0} + std::sin(angle) * up));
    }
  for (int k = 0; k < around; ++k) {
    const int l = (k + 1) % around;
    m.triangles.push_back({k, l, around + k});
    m.triangles.push_back({l, around + l, around + k});
  }
  return m;
}

/// Level ends on both sides of the bar, upright below the middle of its top.
StrapLine levelEnds(double slope) {
  StrapLine line;
  const Vec3 up{0, std::sin(slope), std::cos(slope)};
  for (int i = 0; i <= StrapLine::lines; ++i)
    for (const double side : {1.0, -1.0}) {
      const double a = static_cast<double>(i) / StrapLine::lines - 0.5;
      const Vec3 x = Vec3{side * (kRadius_m + kClearance_m), 0.1 + a * kWidth_m, 1.4} - kDown_m * up;
      (side > 0 ? line.front : line.back).push_back(x);
    }
  line.width_m = kWidth_m;
  line.clearance_m = kClearance_m;
  return line;
}

double lengthOf(const Strap& strap, double s, double from = 0, double to = 1) {
  double length = 0;
  for (int k = 0; k < 400; ++k)
    length += norm(strap.at(s, from + (to - from) * (k + 1) / 400) - strap.at(s, from + (to - from) * k / 400));
  return length;
}

// A bar unrolls: what lies on it without pulling sideways is straight and square to its axis. Unrolled, lines beside
// the middle are parallel to it, and end where the level cut through the side meets them, w sin(slope) higher outside
// than inside at either end.
TEST(Strap, OnASlopingBarIsAStraightStripSquareToIt) {
  const Human human = makeManikin("male_p50");
  for (const double slope : {0.0, 0.25, 0.45}) {
    const TriangleMesh skin = bar(slope);
    const BodyForm form(human, skin, std::vector<int>(skin.vertices.size(), human.skeleton.link("torso")));
    const Strap strap(levelEnds(slope), form);
    EXPECT_NEAR(strap.lean(), slope, 0.01);
    const double middle = 2 * kDown_m + M_PI * (kRadius_m + kClearance_m);
    EXPECT_NEAR(strap.length(), middle, 5e-4);
    for (const double s : {0.0, 1.0}) {
      EXPECT_NEAR(lengthOf(strap, s, 0.2, 0.8), 0.6 * middle, 1e-3) << slope;
      EXPECT_NEAR(lengthOf(strap, s), middle - (2 * s - 1) * kWidth_m * std::sin(slope), 2e-3) << slope;
    }
    for (const double t : {0.0, 0.1, 0.3, 0.5, 0.7, 1.0})
      EXPECT_NEAR(norm(strap.at(1, t) - strap.at(0, t)), kWidth_m, 1e-6) << slope;
    const Vec3 across = strap.at(1, 0.5) - strap.at(0, 0.5);
    EXPECT_NEAR(std::atan2(-across.z, across.y), slope, 0.02);
  }
}

TEST(Strap, KeepsItsEndsAndItsDistance) {
  const Human human = makeManikin("male_p50");
  const TriangleMesh skin = bar(0.4);
  const BodyForm form(human, skin, std::vector<int>(skin.vertices.size(), human.skeleton.link("torso")));
  const StrapLine line = levelEnds(0.4);
  const Strap strap(line, form);
  for (int i = 0; i <= StrapLine::lines; ++i) {
    const double s = static_cast<double>(i) / StrapLine::lines;
    EXPECT_LT(norm(strap.at(s, 0) - line.front[i]), 1e-9);
    EXPECT_LT(norm(strap.at(s, 1) - line.back[i]), 1e-9);
  }
  const Vec3 axis{0, std::cos(0.4), -std::sin(0.4)};
  for (int i = 0; i <= 20; ++i)
    for (int k = 0; k <= 100; ++k) {
      const Vec3 x = strap.at(i / 20.0, k / 100.0) - Vec3{0, 0.1, 1.4};
      EXPECT_GT(norm(x - dot(x, axis) * axis), kRadius_m + 0.98 * kClearance_m);
    }
}

class StrapOn : public testing::TestWithParam<const char*> {};

// A strip whose edges are as long as each other between square cross lines has no turn in its plane (length difference
// over width); one that turns pulls on one edge, and needs a push from the side to stay. Upright strips turned by 0.5.
TEST_P(StrapOn, TheShoulderOfAWearerDoesNotTurnInItsPlane) {
  Human human = makeManikin(GetParam());
  human.skin = std::make_shared<Skin>(makeSkin(human));
  const BodyForm form(human);
  ShirtPattern pattern;
  const Garment shirt = makeShirt(pattern, form, 3e-3, {});
  const auto length = [&](double u) {
    double sum = 0;
    for (int k = 0; k < 200; ++k)
      sum += norm(surfaceDerivatives(shirt.patches[strap_left], u, 0.25 + 0.5 * (k + 1) / 200)[0] -
                  surfaceDerivatives(shirt.patches[strap_left], u, 0.25 + 0.5 * k / 200)[0]);
    return sum;
  };
  EXPECT_LT(std::abs(length(0) - length(1)) / pattern.strap_width_m, 0.15);
}

INSTANTIATE_TEST_SUITE_P(Manikins, StrapOn, testing::ValuesIn(manikinsAsked<const char*>()));

TEST(Strap, EndsBehindTheBodyAreNamed) {
  const Human human = makeManikin("male_p50");
  const TriangleMesh skin = bar(0.3);
  const BodyForm form(human, skin, std::vector<int>(skin.vertices.size(), human.skeleton.link("torso")));
  StrapLine line = levelEnds(0.3);
  for (Vec3& x : line.front) x = {0, x.y, 1.43};
  EXPECT_THROW(Strap(line, form), InputError);
}

}  // namespace
}  // namespace gambeson
