/// The axes of an arm go with it wherever it is raised.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tryon/pattern/arm_form.hpp"

namespace gambeson {
namespace {

void expectFrame(const ArmAxes& a) {
  for (const Vec3& v : {a.forward, a.left, a.up}) EXPECT_NEAR(norm(v), 1, 1e-12);
  EXPECT_LT(norm(cross(a.forward, a.left) - a.up), 1e-12);
}

TEST(ArmAxes, AreThoseOfTheWorldOnAnArmThatHangs) {
  const ArmAxes a = armAxes({0, 0, 1});
  EXPECT_EQ(a.forward, (Vec3{1, 0, 0}));
  EXPECT_EQ(a.left, (Vec3{0, 1, 0}));
}

/// To the side up to over the head the arm turns about x, and forward about y, without a jump.
TEST(ArmAxes, TurnWithTheArm) {
  for (const double side : {-1.0, 1.0})
    for (double angle = 0; angle < 3; angle += 0.01) {
      const ArmAxes a = armAxes({0, side * std::sin(angle), std::cos(angle)});
      expectFrame(a);
      EXPECT_LT(norm(a.forward - Vec3{1, 0, 0}), 1e-12);
      EXPECT_LT(norm(a.left - Vec3{0, std::cos(angle), -side * std::sin(angle)}), 1e-12);
    }
  for (const double way : {-1.0, 1.0})
    for (double angle = 0; angle < 2.5; angle += 0.01) {
      const ArmAxes a = armAxes({-way * std::sin(angle), 0, std::cos(angle)});
      expectFrame(a);
      EXPECT_LT(norm(a.forward - Vec3{std::cos(angle), 0, way * std::sin(angle)}), 1e-12) << angle;
    }
  for (const double x : {-1.0, 1.0}) {
    const ArmAxes a = armAxes({x, 0, 0});
    expectFrame(a);
    EXPECT_LT(norm(a.left - Vec3{0, 1, 0}), 1e-12);
  }
}

}  // namespace
}  // namespace gambeson
