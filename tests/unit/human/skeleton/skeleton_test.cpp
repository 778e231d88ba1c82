#include "human/skeleton/skeleton.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "human/body/body.hpp"
#include "human/manikin/manikin.hpp"

namespace gambeson {
namespace {

/// Two links of lengths 1 and 2 turning about -y, then a slide along x.
Skeleton planar() {
  Skeleton s;
  s.links = {{"base", -1, 0, {}}, {"a", 0, 0, {}}, {"b", 1, 0, {}}, {"c", 2, 0, {}}};
  s.joints.resize(3);
  const double length[] = {0, 1, 2};
  for (int i = 0; i < 3; ++i) {
    s.joints[i].name = std::string(1, static_cast<char>('p' + i));
    s.joints[i].type = i < 2 ? JointType::revolute : JointType::prismatic;
    s.joints[i].parent = i;
    s.joints[i].child = i + 1;
    s.joints[i].X_PJ.origin = {length[i], 0, 0};
    s.joints[i].axis = i < 2 ? Vec3{0, -1, 0} : Vec3{1, 0, 0};
  }
  return s;
}

// Closed form of a planar chain: (cos q0 + (2 + q2) cos(q0 + q1), sin q0 + (2 + q2) sin(q0 + q1)).
TEST(Skeleton, ForwardKinematicsOfAPlanarChain) {
  const Skeleton s = planar();
  const std::vector<double> q{0.3, 0.5, 0.25};
  const Pose root{rotationAbout({0, 0, 1}, 0.7), {1, 2, 3}};
  const auto X = linkPoses(s, q, root);
  const Vec3 tip{std::cos(0.3) + 2.25 * std::cos(0.8), 0, std::sin(0.3) + 2.25 * std::sin(0.8)};
  EXPECT_LT(norm(X[3].origin - root * tip), 1e-14);
}

TEST(Skeleton, MimicJointsFollow) {
  Skeleton s = planar();
  s.joints[1].mimic_of = 0;
  s.joints[1].mimic_multiplier = -2;
  s.joints[1].mimic_offset = 0.1;
  const auto a = linkPoses(s, std::vector<double>{0.3, 99, 0.25}, {});
  const auto b = linkPoses(planar(), std::vector<double>{0.3, -0.5, 0.25}, {});
  EXPECT_LT(norm(a[3].origin - b[3].origin), 1e-14);
}

TEST(Skeleton, FindsNamesAndWhatIsDistal) {
  const Human h = makeManikin("female_p50");
  const Skeleton& s = h.skeleton;
  EXPECT_EQ(s.link("pelvis"), 0);
  EXPECT_EQ(s.link("tail"), -1);
  EXPECT_EQ(s.joint("tail"), -1);
  const int thigh = s.link("thigh_left");
  EXPECT_TRUE(s.isDistal(s.link("foot_left"), thigh));
  EXPECT_TRUE(s.isDistal(thigh, thigh));
  EXPECT_FALSE(s.isDistal(thigh, s.link("foot_left")));
  EXPECT_FALSE(s.isDistal(s.link("foot_right"), thigh));
  EXPECT_TRUE(s.isDistal(s.link("hand_left"), 0));
}

TEST(Body, ObstaclesNameTheirSegmentAndStandAtTheirShape) {
  const Human h = makeManikin("male_p50");
  const auto obstacles = obstaclesOf(h);
  const auto X = linkPoses(h.skeleton, std::vector<double>(h.skeleton.joints.size(), 0.1), {});
  const auto placements = placementsOf(h, X);
  ASSERT_EQ(obstacles.size(), h.shapes.size());
  ASSERT_EQ(placements.size(), h.shapes.size());
  for (std::size_t i = 0; i < h.shapes.size(); ++i) {
    EXPECT_EQ(obstacles[i].segment, h.skeleton.links[h.shapes[i].link].name);
    const Vec3 p{0.01, 0.02, 0.03};
    EXPECT_LT(norm(placements[i] * p - X[h.shapes[i].link] * (h.shapes[i].X_LS * p)), 1e-15);
  }
}

}  // namespace
}  // namespace gambeson
