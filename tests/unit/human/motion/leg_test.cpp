#include "human/motion/leg.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {
namespace {

struct Legged {
  Human human = makeManikin("female_p50");
  Posture posture = standing(human);
  Pose footLink(const Leg& leg) const { return linkPoses(human.skeleton, posture.q, posture.root)[leg.foot->link]; }
};

// Forward kinematics brings the ankle back to where it was wanted, and the foot as footRotation has it, for pelvises
// that tilt and turn and for ankles before, behind, beside and above.
TEST(Leg, ReachesWhatItIsAskedTo) {
  Legged h;
  for (const char* side : {"right", "left"}) {
    const Leg leg = legOf(h.human, side, "a test");
    for (const Vec3& turn : {Vec3{}, Vec3{0.1, -0.3, 0.2}, Vec3{-0.2, 0.4, -0.3}})
      for (const Vec3& way : {Vec3{0.1, 0.02, -0.7}, Vec3{-0.4, 0.1, -0.5}, Vec3{0.3, -0.1, -0.2}, Vec3{0.5, 0, -0.4}})
        for (const double pitch : {0.0, -1.2, 0.4}) {
          h.posture.root = {
              rotationAbout({0, 0, 1}, turn.z) * rotationAbout({0, 1, 0}, turn.y) * rotationAbout({1, 0, 0}, turn.x),
              {1, 2, 3}};
          const Vec3 hip = h.posture.root * leg.hip_P, ankle = hip + way;
          const auto q = reach(h.human, leg, h.posture.root, ankle, pitch);
          ASSERT_TRUE(q);
          leg.set(*q, h.posture);
          const Pose X = h.footLink(leg);
          EXPECT_LT(norm(X.origin - ankle), 1e-12);
          const Mat3 R = footRotation(hip, ankle, pitch);
          EXPECT_LT(norm(X.rotation.a - R.a) + norm(X.rotation.b - R.b) + norm(X.rotation.c - R.c), 1e-12);
          EXPECT_GT((*q)[3], 0);
          for (std::size_t k = 0; k < q->size(); ++k) EXPECT_EQ(leg.anglesOf(h.posture)[k], (*q)[k]);
        }
  }
}

TEST(Leg, LevelFeetPointAhead) {
  const Mat3 R = footRotation({0, 0.1, 0.8}, {0.3, 0.2, 0.1}, 0);
  EXPECT_NEAR(R.a.x, 1, 1e-15);
  EXPECT_NEAR(R.b.z, 0.1 / std::hypot(0.1, 0.7), 1e-12);  // rolls with the plane of the leg
  const Mat3 up = footRotation({0, 0, 0.8}, {0.3, 0, 0.1}, 0.5);
  EXPECT_NEAR(up.a.z, std::sin(0.5), 1e-15);  // toes up
}

// The knee reaches its ankle until the leg is straight, within rounding of the lengths of the two links.
TEST(Leg, IsNoLongerThanItIs) {
  Legged h;
  const Leg leg = legOf(h.human, "left", "a test");
  const Vec3 hip = h.posture.root * leg.hip_P;
  const double L = leg.length_m();
  EXPECT_TRUE(reach(h.human, leg, h.posture.root, hip + Vec3{0, 0, -L * (1 - 1e-9)}, 0));
  EXPECT_FALSE(reach(h.human, leg, h.posture.root, hip + Vec3{0, 0, -L * (1 + 1e-9)}, 0));
  const auto q = reach(h.human, leg, h.posture.root, hip + Vec3{0, 0, -L * std::cos(0.3)}, 0);
  ASSERT_TRUE(q);
  EXPECT_NEAR((*q)[3], 0.6, 0.02);  // two links of nearly the same length
}

// Bones that lean sideways by a millimetre: the straight leg reaches its own ankle, and the foot is beside it by that.
TEST(Leg, BonesMayLean) {
  Legged h;
  for (Joint& joint : h.human.skeleton.joints)
    if (joint.name == "ankle_flexion_left") joint.X_PJ.origin.y = 1e-3;
  const Leg leg = legOf(h.human, "left", "a test");
  const Vec3 ankle = h.footLink(leg).origin;
  const auto q = reach(h.human, leg, h.posture.root, ankle, 0);
  ASSERT_TRUE(q);
  leg.set(*q, h.posture);
  EXPECT_LT(norm(h.footLink(leg).origin - ankle), 1.1e-3);
}

TEST(Leg, NeedsItsJoints) {
  Human h = makeManikin("male_p5");
  for (const char* joint : {"hip_flexion_left", "hip_rotation_left", "knee_flexion_left", "ankle_flexion_left"}) {
    Human without = h;
    without.skeleton.joints[without.skeleton.joint(joint)].name = "x";
    EXPECT_THROW(legOf(without, "left", "a test"), InputError) << joint;
    EXPECT_NO_THROW(legOf(without, "right", "a test"));
  }
  Human skew = h;
  skew.skeleton.joints[skew.skeleton.joint("hip_adduction_left")].axis = {0.6, 0.8, 0};
  EXPECT_THROW(legOf(skew, "left", "a test"), InputError);
  Human apart = h;
  apart.skeleton.joints[apart.skeleton.joint("hip_rotation_left")].X_PJ.origin.z = -0.1;
  EXPECT_THROW(legOf(apart, "left", "a test"), InputError);
}

}  // namespace
}  // namespace gambeson
