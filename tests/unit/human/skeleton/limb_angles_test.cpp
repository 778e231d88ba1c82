#include "human/skeleton/limb_angles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/curve.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {
namespace {

double distance(const Mat3& a, const Mat3& b) { return norm(a.a - b.a) + norm(a.b - b.b) + norm(a.c - b.c); }

// Closed form against the product of rotations that it inverts, for both hands and all octants.
TEST(LimbAngles, ThreeAnglesRebuildTheRotation) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-3.1, 3.1);
  for (int i = 0; i < 200; ++i) {
    const Mat3 turn = rotationAbout({0, 0, 1}, any(random)) * rotationAbout({1, 0, 0}, any(random));
    const double hand = i % 2 ? 1 : -1;
    const std::array<Vec3, 3> axes{turn.a, turn.b, hand * turn.c};
    std::array<double, 3> q{any(random), any(random) / 2, any(random)};
    if (i % 10 == 0) q[1] = std::numbers::pi / 2;  // only a combination of the others is known
    const auto rotation = [&](const std::array<double, 3>& a) {
      return rotationAbout(axes[0], a[0]) * rotationAbout(axes[1], a[1]) * rotationAbout(axes[2], a[2]);
    };
    const auto found = threeAngles(rotation(q), axes);
    EXPECT_LT(distance(rotation(found), rotation(q)), 1e-7) << i;
    if (i % 10 == 0) continue;
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(std::remainder(found[k] - q[k], 2 * std::numbers::pi), 0, 1e-9);
  }
}

// Forward kinematics gives the directions of bones; from them come the joint values again.
TEST(LimbAngles, DirectionsGiveBackTheJointsThatMadeThem) {
  const Human human = makeManikin("male_p50");
  const Skeleton& s = human.skeleton;
  const LimbJoints joints = limbJoints(s);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> share(0.1, 0.9);
  for (int i = 0; i < 50; ++i) {
    Posture p = standing(human);
    for (std::size_t j = 0; j < s.joints.size(); ++j) {
      const Joint& joint = s.joints[j];
      if (joint.type == JointType::revolute) p.q[j] = joint.lower + share(random) * (joint.upper - joint.lower);
    }
    p.root.rotation = rotationAbout({0, 0, 1}, 6 * share(random)) * rotationAbout({0, 1, 0}, 0.3);
    const auto X = linkPoses(s, p.q, p.root);
    const auto bone = [&](const std::string& link, const std::string& joint_at_its_end) {
      return X[s.link(link)].rotation * normalized(s.joints[s.joint(joint_at_its_end)].X_PJ.origin);
    };
    BodyDirections b;
    b.pelvis = X[0].rotation, b.torso = X[s.link("torso")].rotation, b.head = X[s.link("head")].rotation;
    for (int side = 0; side < 2; ++side) {
      const std::string of = side == 0 ? "_right" : "_left";
      const Mat3 thigh = X[s.link("thigh" + of)].rotation, arm = X[s.link("upper_arm" + of)].rotation;
      b.leg[side] = {bone("thigh" + of, "knee_flexion" + of), bone("shank" + of, "ankle_flexion" + of), thigh.b};
      b.foot[side] = X[s.link("foot" + of)].rotation.a;
      b.arm[side] =
          LimbDirections{bone("upper_arm" + of, "elbow_flexion" + of), bone("forearm" + of, "wrist" + of), -arm.b};
    }
    std::vector<double> q = p.q;  // of the two solutions of a ball joint the nearer one is taken
    for (double& v : q) v += 0.05;
    setDirections(s, joints, b, q);
    for (std::size_t j = 0; j < s.joints.size(); ++j)
      if (s.joints[j].type == JointType::revolute) {
        EXPECT_NEAR(q[j], p.q[j], 1e-7) << s.joints[j].name;
      }
  }
}

// A spline through a cubic's values and end slopes errs with the fourth order: halving the step, 16 times less.
TEST(LimbAngles, SplinesOfRecordingsConverge) {
  const auto error = [](int n) {
    std::vector<double> t, x;
    for (int i = 0; i <= n; ++i) t.push_back(2.0 * i / n), x.push_back(std::sin(3 * t.back()));
    const auto m = splineSlopes(t, x);
    double worst = 0;
    for (int i = n / 4; i < 3 * n / 4; ++i) {
      const double h = t[i + 1] - t[i], middle = 0.5 * (x[i] + x[i + 1]) + h / 8 * (m[i] - m[i + 1]);
      worst = std::max(worst, std::abs(middle - std::sin(3 * (t[i] + h / 2))));
    }
    return worst;
  };
  EXPECT_NEAR(std::log2(error(40) / error(80)), 4, 0.3);
}

TEST(LimbAngles, NamesAJointThatIsMissing) {
  Human human = makeManikin("male_p50");
  human.skeleton.joints[human.skeleton.joint("knee_flexion_left")].name = "bend";
  EXPECT_THROW(limbJoints(human.skeleton), std::exception);
}

}  // namespace
}  // namespace gambeson
