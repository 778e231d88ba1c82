#include "human/motion/sit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/inverse_statics.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "unit/human/manikin/clearance.hpp"
#include "unit/manikins_asked.hpp"

namespace gambeson {
namespace {

class EverySit : public testing::TestWithParam<std::string> {
 protected:
  Human human = makeManikin(GetParam());
  SitOptions options;
  std::unique_ptr<Motion> sit = makeSit(human, options);

  std::vector<Pose> poses(double t) const {
    const Posture p = sit->at(t);
    return linkPoses(human.skeleton, p.q, p.root);
  }
  Pose foot(double t, const std::string& side) const {
    const BodyShape& s = footOf(human, side, "");
    return poses(t)[s.link] * s.X_LS;
  }
};

TEST_P(EverySit, StartsAndEndsStanding) {
  const Posture stands = standing(human);
  for (const double t : {0.0, sit->duration()}) {
    const Posture p = sit->at(t);
    for (std::size_t j = 0; j < p.q.size(); ++j) EXPECT_NEAR(p.q[j], stands.q[j], 1e-9);
    EXPECT_LT(norm(p.root.origin - stands.root.origin), 1e-9);
  }
}

/// The feet stay: ankles to the millimetres that the feet roll by, lowest points on the ground, no turn about z.
TEST_P(EverySit, FeetStayWhereTheyStand) {
  double slip = 0, height = 0, roll = 0;
  const int n = 200;
  for (const char* side : {"left", "right"}) {
    const Pose first = foot(0, side);
    for (int i = 0; i <= n; ++i) {
      const Pose X = foot(sit->duration() * i / n, side);
      slip = std::max(slip, std::hypot(X.origin.x - first.origin.x, X.origin.y - first.origin.y));
      height = std::max(height, std::abs((X * lowestPoint(footOf(human, side, "").shape, X.rotation)).z));
      const Vec3 forward = transpose(first.rotation) * (X.rotation * Vec3{1, 0, 0});
      roll = std::max(roll, std::hypot(forward.y, forward.z));
    }
  }
  std::printf("[ measured ] feet move by %.2g mm, lowest points off the ground by %.2g mm\n", 1e3 * slip, 1e3 * height);
  EXPECT_LT(slip, 0.006);
  EXPECT_LT(height, 1e-9);
  EXPECT_LT(roll, 1e-9);
}

TEST_P(EverySit, ReachesTheSeat) {
  double lowest = 1;
  for (int i = 0; i <= 200; ++i) {
    const std::vector<Pose> X = poses(sit->duration() * i / 200);
    for (const BodyShape& s : human.shapes) {
      if (s.link != 0) continue;
      const Pose of = X[s.link] * s.X_LS;
      lowest = std::min(lowest, (of * lowestPoint(s.shape, of.rotation)).z);
    }
  }
  EXPECT_GE(lowest, options.seat_height_m - 1e-6);
  EXPECT_LT(lowest, options.seat_height_m + 0.06);
}

/// Seated, the pelvis is upright and the hips bend by no more than thighs do that are near to level.
TEST_P(EverySit, SitsUpright) {
  const double t = options.stand_s + 0.5 * options.duration_s;
  const Posture p = sit->at(t);
  EXPECT_LT(norm(p.root.rotation * Vec3{0, 0, 1} - Vec3{0, 0, 1}), 1e-9);
  const double hip = p.q[human.skeleton.joint("hip_flexion_left")] / rad_per_deg;
  const double lumbar = p.q[human.skeleton.joint("lumbar_flexion")] / rad_per_deg;
  std::printf("[ measured ] hips bent by %.0f degrees, back by %.1f\n", hip, lumbar);
  EXPECT_GT(hip, 55);
  EXPECT_LT(hip, 90);
  EXPECT_GT(lumbar, 0);
  EXPECT_LT(lumbar, 10);
}

/// While nothing but the feet carries, the centre of mass is above them.
TEST_P(EverySit, BalancesUntilTheSeatCarries) {
  const BodyShape& shape = footOf(human, "left", "");
  const double half = std::get<Ellipsoid>(shape.shape).semi_axes.x, middle = foot(0, "left").origin.x;
  double rear = 1, front = 1;
  for (int i = 0; i <= 100; ++i) {
    const double t = options.stand_s + 0.3 * options.duration_s * i / 100;
    const double x = centreOfMass(human, poses(t), {}).x;
    rear = std::min(rear, x - (middle - half));
    front = std::min(front, middle + half - x);
  }
  std::printf("[ measured ] centre of mass at least %.0f mm before the heel, %.0f behind the toes\n", 1e3 * rear,
              1e3 * front);
  EXPECT_GT(rear, 0.2 * 2 * half);
  EXPECT_GT(front, 0.2 * 2 * half);
}

TEST_P(EverySit, LimbsStayApartAndWithinTheirLimits) {
  double hands = 1, arms = 1;
  const int n = 100;
  for (int i = 0; i <= n; ++i) {
    const double t = sit->duration() * i / n;
    const auto X = poses(t);
    hands = std::min(hands, test::clearance(human, X, {"hand", "forearm"}, {"pelvis", "iliac", "thigh", "knee"}));
    arms = std::min(arms, test::clearance(human, X, {"hand", "forearm"}, {"waist", "chest"}));
    const Posture p = sit->at(t);
    for (std::size_t j = 0; j < p.q.size(); ++j) {
      ASSERT_GE(p.q[j], human.skeleton.joints[j].lower - 1e-9) << human.skeleton.joints[j].name << " at " << t;
      ASSERT_LE(p.q[j], human.skeleton.joints[j].upper + 1e-9) << human.skeleton.joints[j].name << " at " << t;
    }
  }
  std::printf("[ measured ] hands %.0f mm from the legs, arms %.0f mm from the trunk\n", 1e3 * hands, 1e3 * arms);
  EXPECT_GT(hands, 0.005);
  EXPECT_GT(arms, 0.005);
}

/// Velocities are continuous: differences of the second order stay small.
TEST_P(EverySit, MovesSmoothly) {
  const double h = 1e-3;
  double most = 0;
  for (double t = 0; t + 2 * h < sit->duration(); t += h) {
    const Posture a = sit->at(t), b = sit->at(t + h), c = sit->at(t + 2 * h);
    for (std::size_t j = 0; j < a.q.size(); ++j)
      most = std::max(most, std::abs(c.q[j] - 2 * b.q[j] + a.q[j]) / h);  // change of velocity [rad/s]
  }
  EXPECT_LT(most, 0.05);
}

INSTANTIATE_TEST_SUITE_P(OfAllManikins, EverySit, testing::ValuesIn(manikinsAsked()));

TEST(Sit, RepeatsItself) {
  const Human human = makeManikin("male_p50");
  SitOptions o;
  o.repeats = 2;
  const auto sit = makeSit(human, o);
  EXPECT_DOUBLE_EQ(sit->duration(), o.stand_s + 2 * o.duration_s);
  const Posture a = sit->at(o.stand_s + 1.1), b = sit->at(o.stand_s + o.duration_s + 1.1);
  for (std::size_t j = 0; j < a.q.size(); ++j) EXPECT_NEAR(a.q[j], b.q[j], 1e-12);
}

TEST(Sit, RefusesSeatsThatNobodyReaches) {
  const Human human = makeManikin("male_p50");
  for (const double height : {0.2, 0.79}) {
    SitOptions o;
    o.seat_height_m = height;
    EXPECT_THROW(makeSit(human, o), InputError) << height;
  }
}

}  // namespace
}  // namespace gambeson
