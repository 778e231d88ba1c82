#include "human/body/segment_ellipsoid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/walk.hpp"

namespace gambeson {
namespace {

double difference(const Mat3& a, const Mat3& b) { return norm(a.a - b.a) + norm(a.b - b.b) + norm(a.c - b.c); }

Mat3 turn(double x, double y, double z) {
  return rotationAbout({0, 0, 1}, z) * rotationAbout({0, 1, 0}, y) * rotationAbout({1, 0, 0}, x);
}

// Man 2006, 5.1, by hand: J1 above J2, M to the front.
TEST(SegmentEllipsoid, IsThatOfMan) {
  const Pose X = segmentPose({0.1, 0.2, 0.9}, {0.1, 0.2, 0.5}, {0.3, 0.2, 0.8}, "thigh");
  EXPECT_LT(norm(X.origin - Vec3{0.1, 0.2, 0.7}), 1e-15);
  EXPECT_LT(difference(X.rotation, {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}}), 1e-15);
}

TEST(SegmentEllipsoid, HasAnOrthonormalRightHandedBasisThatMovesRigidly) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const auto point = [&] { return Vec3{normal(random), normal(random), normal(random)}; };
  for (int k = 0; k < 200; ++k) {
    const Vec3 J1 = point(), J2 = point(), M = point();
    const Pose X = segmentPose(J1, J2, M, "segment");
    const Mat3 R = X.rotation;
    EXPECT_LT(difference(R * transpose(R), {}), 1e-13);
    EXPECT_NEAR(dot(cross(R.a, R.b), R.c), 1, 1e-13);
    EXPECT_LT(norm(X.origin - 0.5 * (J1 + J2)), 1e-15);
    EXPECT_GT(dot(R.b, M - X.origin), 0);
    const Pose moved{turn(normal(random), normal(random), normal(random)), point()};
    const Pose after = segmentPose(moved * J1, moved * J2, moved * M, "segment"), with = moved * X;
    EXPECT_LT(difference(after.rotation, with.rotation), 1e-12);
    EXPECT_LT(norm(after.origin - with.origin), 1e-13);
  }
}

// The thigh of a man who walks, its knee, hip and a point at its side as J2, J1 and M: the ellipsoid goes with the
// link.
TEST(SegmentEllipsoid, FollowsAMotionContinuously) {
  const Human human = makeManikin("male_p50");
  const auto walk = makeWalk(human, {});
  const int thigh = human.skeleton.link("thigh_right");
  const Vec3 knee = human.skeleton.joints[human.skeleton.joint("knee_flexion_right")].X_PJ.origin, side{0, -0.1, -0.1};
  SegmentCourse segment{"thigh_right", {}, {}, {}};
  std::vector<Pose> links;
  constexpr double every_s = 0.01;
  for (double t = 0; t < walk->duration(); t += every_s) {
    const Posture p = walk->at(t);
    const Pose X = linkPoses(human.skeleton, p.q, p.root)[thigh];
    links.push_back(X);
    segment.J1.push_back(X.origin), segment.J2.push_back(X * knee), segment.M.push_back(X * side);
  }
  const auto poses = segmentPoses(segment);
  ASSERT_EQ(poses.size(), links.size());
  const Mat3 in_link = transpose(links[0].rotation) * poses[0].rotation;
  double most = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_LT(difference(poses[i].rotation, links[i].rotation * in_link), 1e-12);
    EXPECT_LT(norm(poses[i].origin - links[i] * (0.5 * knee)), 1e-12);
    if (i > 0) most = std::max(most, difference(poses[i].rotation, poses[i - 1].rotation));
  }
  EXPECT_LT(most, 0.2);  // thighs turn by at most 5 rad/s
}

TEST(SegmentEllipsoid, RefusesWhatHasNoDirection) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 J1{0, 0, 1}, J2{0, 0, 0.6};
  const auto keyOf = [](auto f) -> std::string {
    try {
      f();
    } catch (const InputError& e) {
      return e.where().key;
    }
    return "nothing";
  };
  EXPECT_EQ(keyOf([&] { segmentPose(J1, J1 + Vec3{0, 0, 5e-4}, {1, 0, 0}, "thigh"); }), "thigh");
  EXPECT_EQ(keyOf([&] { segmentPose(J1, J2, {0, 0, 3}, "thigh"); }), "thigh");  // M beyond an end, on the line
  EXPECT_EQ(keyOf([&] { segmentPose(J1, J2, {3.9e-4, 0, 0.7}, "thigh"); }), "thigh");
  EXPECT_EQ(keyOf([&] { segmentPose(J1, J2, {4.1e-4, 0, 0.7}, "thigh"); }), "nothing");
  EXPECT_EQ(keyOf([&] { segmentPose(J1, {nan, 0, 0}, {1, 0, 0}, "thigh"); }), "thigh");
  EXPECT_EQ(keyOf([&] { segmentPose(J1, J2, {0, nan, 0}, "thigh"); }), "thigh");
  const SegmentCourse changes{"shank", {J1, J1}, {J2, J2}, {{0.1, 0, 0.8}, {-0.1, 0, 0.8}}};
  EXPECT_EQ(keyOf([&] { segmentPoses(changes); }), "shank[1]");
  const SegmentCourse short_of_one{"shank", {J1, J1}, {J2, J2}, {{0.1, 0, 0.8}}};
  EXPECT_EQ(keyOf([&] { segmentPoses(short_of_one); }), "shank");
}

}  // namespace
}  // namespace gambeson
