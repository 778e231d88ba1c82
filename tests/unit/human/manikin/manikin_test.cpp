#include "human/manikin/manikin.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "human/files/data.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "unit/human/manikin/clearance.hpp"

namespace gambeson {
namespace {

const BodyShape& shapeOf(const Human& h, const std::string& name) {
  for (const BodyShape& s : h.shapes)
    if (s.name == name) return s;
  throw std::runtime_error("no shape " + name);
}
Vec3 semiAxes(const Human& h, const std::string& name) { return std::get<Ellipsoid>(shapeOf(h, name).shape).semi_axes; }

class EveryManikin : public testing::TestWithParam<std::string> {
 protected:
  Human human = makeManikin(GetParam());
  nlohmann::json facts = nlohmann::json::parse(data::manikins).at("manikins").at(GetParam());
  std::vector<Pose> zero(std::vector<std::pair<std::string, double>> q = {}) const {
    std::vector<double> values(human.skeleton.joints.size());
    for (const auto& [name, value] : q) values.at(human.skeleton.joint(name)) = value;
    return linkPoses(human.skeleton, values, {{}, {0, 0, facts.at("joint_centres_m").at("hip_height")}});
  }
  Vec3 origin(const std::vector<Pose>& X, const std::string& link) const {
    return X.at(human.skeleton.link(link)).origin;
  }
};

TEST_P(EveryManikin, JointCentresStandWhereTheDataSay) {
  const auto X = zero();
  const auto height = [&](const char* name) { return facts.at("joint_centres_m").at(name).get<double>(); };
  for (const std::string side : {"right", "left"}) {
    const double s = side == "left" ? 1 : -1;
    EXPECT_NEAR(origin(X, "thigh_" + side).z, height("hip_height"), 1e-12);
    EXPECT_NEAR(origin(X, "thigh_" + side).y, s * height("hip_lateral_half"), 1e-12);
    EXPECT_NEAR(origin(X, "shank_" + side).z, height("knee_height"), 2e-4);  // the data are rounded to 0.1 mm
    EXPECT_NEAR(origin(X, "foot_" + side).z, height("ankle_height"), 2e-4);
    EXPECT_NEAR(origin(X, "upper_arm_" + side).z, height("shoulder_height"), 1e-12);
    EXPECT_NEAR(origin(X, "upper_arm_" + side).y, s * height("shoulder_lateral_half"), 1e-12);
    EXPECT_NEAR(origin(X, "forearm_" + side).z, height("elbow_height"), 2e-4);
    EXPECT_NEAR(origin(X, "hand_" + side).z, height("wrist_height"), 2e-4);
  }
  EXPECT_NEAR(origin(X, "torso").z, height("lumbar_L5S1_height"), 1e-12);
  EXPECT_NEAR(origin(X, "head").z, height("neck_C7_height"), 1e-12);
  EXPECT_NEAR(lowestHeight(human, X), 0, 3e-4);
  double top = 0;
  for (const BodyShape& s : human.shapes)
    top = std::max(top, (X[s.link] * s.X_LS).origin.z + std::get<Ellipsoid>(s.shape).semi_axes.z);
  EXPECT_NEAR(top, human.stature_m, 1e-12);
}

TEST_P(EveryManikin, MassesAddUp) {
  double sum = 0;
  for (const Link& l : human.skeleton.links) sum += l.mass_kg;
  EXPECT_NEAR(sum, human.mass_kg, 0.01);  // segment masses in the data are rounded to 1 g
}

// The perimeter by the trapezoidal rule (exponentially accurate for an ellipse) is that of the data's round thigh.
TEST_P(EveryManikin, FlattenedThighKeepsItsGirth) {
  const Vec3 a = semiAxes(human, "thigh_left");
  EXPECT_LT(a.y, facts.at("joint_centres_m").at("hip_lateral_half"));
  double girth = 0;
  const int n = 400;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n;
    girth += 2 * std::numbers::pi / n * std::hypot(a.x * std::sin(t), a.y * std::cos(t));
  }
  const double round = facts.at("ellipsoid_semi_axes_m").at("thigh").at(1);
  EXPECT_NEAR(girth, 2 * std::numbers::pi * round, 1e-9);
  EXPECT_NEAR(girth, facts.at("thigh_girth_m"), 1e-3);
}

TEST_P(EveryManikin, SignsAreTheSameOnBothSides) {
  const double a = 0.3;
  const auto X0 = zero();
  for (const std::string side : {"_right", "_left"}) {
    const double out = side == "_left" ? 1 : -1;
    const auto moved = [&](const std::string& joint, const std::string& link, const Vec3& p_L) {
      const int l = human.skeleton.link(link);
      return zero({{joint + side, a}})[l] * p_L - X0[l] * p_L;
    };
    EXPECT_GT(moved("hip_flexion", "shank" + side, {}).x, 0.1);
    EXPECT_LT(moved("hip_adduction", "shank" + side, {}).y * out, -0.1);
    EXPECT_LT(moved("hip_rotation", "foot" + side, {0.1, 0, 0}).y * out, -0.02);
    EXPECT_LT(moved("knee_flexion", "foot" + side, {}).x, -0.1);
    EXPECT_GT(moved("ankle_flexion", "foot" + side, {0.1, 0, 0}).z, 0.02);
    EXPECT_GT(moved("shoulder_flexion", "forearm" + side, {}).x, 0.05);
    EXPECT_GT(moved("shoulder_abduction", "forearm" + side, {}).y * out, 0.05);
    EXPECT_LT(moved("shoulder_rotation", "hand" + side, {0.1, 0, 0}).y * out, -0.02);
    EXPECT_GT(moved("elbow_flexion", "hand" + side, {}).x, 0.05);
  }
  const auto head = [&](const char* joint, const Vec3& p) {
    return zero({{joint, a}})[human.skeleton.link("head")] * p - X0[human.skeleton.link("head")] * p;
  };
  EXPECT_GT(head("lumbar_flexion", {}).x, 0.1);
  EXPECT_LT(head("lumbar_bending", {}).y, -0.1);
  EXPECT_GT(head("lumbar_rotation", {0, -0.1, 0}).x, 0.02);
  EXPECT_GT(head("neck_flexion", {0, 0, 0.1}).x, 0.02);
}

TEST_P(EveryManikin, StandsOnTheGroundWithLegsAndArmsApart) {
  const Posture p = standing(human);
  const auto X = linkPoses(human.skeleton, p.q, p.root);
  EXPECT_NEAR(lowestHeight(human, X), 0, 1e-12);
  EXPECT_GE(test::clearance(human, X, {"thigh_left", "knee_left", "shank_left", "foot_left"},
                            {"thigh_right", "knee_right", "shank_right", "foot_right"}),
            0.020);
  EXPECT_GE(test::clearance(human, X, {"hand", "forearm"}, {"pelvis", "iliac", "thigh"}), 0.060);
}

INSTANTIATE_TEST_SUITE_P(All, EveryManikin, testing::ValuesIn(manikinNames()), [](const auto& i) { return i.param; });

TEST(Manikin, UnknownNameListsTheKnownOnes) {
  try {
    makeManikin("male_p42");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("male_p42"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("female_p95"), std::string::npos);
  }
}

}  // namespace
}  // namespace gambeson
