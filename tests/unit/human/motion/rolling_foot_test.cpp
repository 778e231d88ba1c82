#include "human/motion/rolling_foot.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "human/body/ground.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/rounded_line.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {
namespace {

/// A right leg under a pelvis that stays above the foot's middle line, so that the foot rolls in the plane y = const.
struct Roller {
  Human human = makeManikin("male_p50");
  Leg leg = legOf(human, "right", "a test");
  Posture stands = standing(human);
  Vec3 ankle{0, stands.root.origin.y + leg.hip_P.y, 0};

  std::vector<Vec3> roll(const std::vector<FootGoal>& goals) const {
    return rolledAnkles(leg, std::vector<Pose>(goals.size(), stands.root), goals, ankle);
  }
  Pose foot(const Vec3& at, double pitch) const {
    return Pose{footRotation(stands.root * leg.hip_P, at, pitch), at} * leg.foot->X_LS;
  }
};

/// Arc of an ellipse from its end on the axis of `b`, over the normal's angle: radius of curvature a² b² / h³ with
/// h² = a² sin² + b² cos² (support function).
double arcOf(double a, double b, double angle) {
  constexpr int n = 20000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    const double t = angle * (i + 0.5) / n, h2 = std::pow(a * std::sin(t), 2) + std::pow(b * std::cos(t), 2);
    sum += a * a * b * b / std::pow(h2, 1.5) * angle / n;
  }
  return sum;
}

std::vector<FootGoal> pitched(double to, int n) {
  std::vector<FootGoal> goals;
  for (int i = 0; i <= n; ++i) goals.push_back({to * i / n, {}});
  return goals;
}

// What rolls without slip lays its own arc on the ground: the foot's lowest point goes as far as the arc of its
// ellipse.
TEST(RollingFoot, LaysItsArcOnTheGround) {
  const Roller r;
  const Vec3 a = std::get<Ellipsoid>(r.leg.foot->shape).semi_axes;
  for (const double to : {-0.4, -1.3, -2.3, 0.3}) {
    const auto goals = pitched(to, 2000);
    const auto at = r.roll(goals);
    const Pose first = r.foot(at.front(), 0), last = r.foot(at.back(), to);
    const Vec3 from = first * lowestPoint(r.leg.foot->shape, first.rotation),
               now = last * lowestPoint(r.leg.foot->shape, last.rotation);
    EXPECT_NEAR(now.x - from.x, -arcOf(a.x, a.z, to), 1e-6) << to;
    EXPECT_NEAR(now.z, 0, 1e-12);
    EXPECT_NEAR(now.y, from.y, 1e-9);
  }
}

TEST(RollingFoot, ErrorsFallWithTheSquareOfTheStep) {
  const Roller r;
  const auto end = [&](int n) { return r.roll(pitched(-1.3, n)).back().x; };
  const double fine = end(3200), coarse = std::abs(end(50) - fine), half = std::abs(end(100) - fine);
  EXPECT_NEAR(std::log2(coarse / half), 2, 0.1);
}

// Carried, the foot goes as far as it is carried, and as high, and what it has rolled forward it rolls back.
TEST(RollingFoot, IsCarried) {
  const Roller r;
  std::vector<FootGoal> goals;
  for (int i = 0; i <= 400; ++i) {
    const double u = i / 400.0;
    goals.push_back({-0.5 * smoothBump(u), {0.6 * smootherStep(u), 0, 0.1 * smoothBump(u)}});
  }
  const auto at = r.roll(goals);
  EXPECT_NEAR(at.back().x - at.front().x, 0.6, 1e-6);
  EXPECT_NEAR(at.back().z, at.front().z, 1e-6);
  const Pose middle = r.foot(at[200], goals[200].pitch);
  EXPECT_NEAR((middle * lowestPoint(r.leg.foot->shape, middle.rotation)).z, 0.1, 1e-12);
}

TEST(RoundedLine, IsSmoothAndStaysInItsRange) {
  const RoundedLine line({1, 2, 4}, {0, 3, -1}, 0.3);
  EXPECT_EQ(line.at(0), 0);
  EXPECT_EQ(line.at(0.7), 0);
  EXPECT_NEAR(line.at(5), -1, 1e-15);
  EXPECT_NEAR(line.at(1.5), 1.5, 1e-15);  // on the straight parts
  EXPECT_NEAR(line.at(3), 1, 1e-15);
  double jump = 0;
  constexpr double h = 1e-3;
  for (double t = 0; t < 5; t += h) {
    EXPECT_LE(line.at(t), 3 + 1e-14);
    EXPECT_GE(line.at(t), -1 - 1e-14);
    const double bend = (line.at(t + h) - 2 * line.at(t) + line.at(t - h)) / (h * h),
                 next = (line.at(t + 2 * h) - 2 * line.at(t + h) + line.at(t)) / (h * h);
    jump = std::max(jump, std::abs(next - bend));
  }
  EXPECT_LT(jump, 0.2);  // slopes change by 5 within 0.6 s: the second derivative is continuous
}

}  // namespace
}  // namespace gambeson
