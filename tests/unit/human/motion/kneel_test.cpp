#include "human/motion/kneel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/foot_report.hpp"
#include "unit/human/manikin/clearance.hpp"
#include "unit/manikins_asked.hpp"

namespace gambeson {
namespace {

/// A manikin that stands at low ready for a quarter of a second, goes down, holds, and gets up.
struct Kneeling {
  explicit Kneeling(const std::string& name = "male_p50") : human(makeManikin(name)) {
    options.stand_s = 0.25;
    kneel = makeKneel(human, options);
  }
  std::vector<Pose> poses(double t) const {
    const Posture p = kneel->at(t);
    return linkPoses(human.skeleton, p.q, p.root);
  }
  double q(double t, const std::string& joint) const {
    return kneel->at(t).q.at(human.skeleton.joint(joint)) / rad_per_deg;
  }
  const BodyShape& shape(const std::string& name) const {
    return *std::find_if(human.shapes.begin(), human.shapes.end(), [&](const BodyShape& s) { return s.name == name; });
  }
  double height(double t, const std::string& name) const {
    const BodyShape& s = shape(name);
    return gapTo(s.shape, poses(t)[s.link] * s.X_LS, std::nullopt);
  }
  double time(double u) const { return options.stand_s + u * options.duration_s; }
  double down() const { return time(1) + 0.5 * options.hold_s; }
  Human human;
  KneelOptions options;
  std::unique_ptr<Motion> kneel;
};

// Arms of a scan that may not hang as low as the data have them (5 to 40 degrees) stay as far out as they may.
TEST(Kneel, KeepsTheLimitsOfTheShoulders) {
  Human human = makeManikin("male_p50");
  for (const char* side : {"_left", "_right"})
    human.skeleton.joints[human.skeleton.joint(std::string("shoulder_abduction") + side)].lower = 30 * rad_per_deg;
  const auto kneel = makeKneel(human, {});
  for (int i = 0; i <= 20; ++i) {
    const Posture p = kneel->at(kneel->duration() * i / 20);
    for (std::size_t j = 0; j < p.q.size(); ++j)
      if (human.skeleton.joints[j].name.starts_with("shoulder_")) {
        EXPECT_GE(p.q[j], human.skeleton.joints[j].lower - 1e-12) << human.skeleton.joints[j].name << " at " << i;
      }
  }
}

class EveryKneel : public testing::TestWithParam<std::string> {
 protected:
  Kneeling k{GetParam()};
};

// human/data/kneel.json: right hip 2 flexed, 5 abducted, ankles -35 and 0. The knees (90 in the data) and the left hip
// (88) are what lets knee and feet meet the ground.
TEST_P(EveryKneel, EndsAsTheDataSay) {
  const double t = k.down();
  EXPECT_NEAR(k.q(t, "hip_flexion_right"), 2, 1e-8);
  EXPECT_NEAR(k.q(t, "hip_adduction_right"), -5, 1e-8);
  EXPECT_NEAR(k.q(t, "ankle_flexion_right"), -35, 1e-8);
  EXPECT_NEAR(k.q(t, "ankle_flexion_left"), 0, 1e-8);
  EXPECT_NEAR(k.q(t, "lumbar_flexion"), 8, 1e-9);
  EXPECT_NEAR(k.q(t, "elbow_flexion_right"), 115, 1e-9);
  EXPECT_NEAR(k.q(t, "knee_flexion_left"), 90, 8);
  EXPECT_NEAR(k.q(t, "knee_flexion_right"), 90, 16);
  EXPECT_NEAR(k.q(t, "hip_flexion_left"), 88, 8);
}

// The right thigh is upright and stands on its knee, so the pelvis is as high as that thigh is long and its knee thick
// (the data's pelvis height: thigh length + knee radius).
TEST_P(EveryKneel, RestsOnTheRightKnee) {
  const double t = k.down();
  EXPECT_NEAR(k.height(t, "knee_right"), 0, 1e-9);
  EXPECT_GT(k.height(t, "shank_right"), 0);
  const double thigh = norm(k.human.skeleton.joints[k.human.skeleton.joint("knee_flexion_right")].X_PJ.origin);
  const double radius = std::get<Ellipsoid>(k.shape("knee_right").shape).semi_axes.x;
  EXPECT_NEAR(k.kneel->at(t).root.origin.z, thigh + radius, 0.01);
  for (int i = 0; i < 100; ++i)
    for (const char* name : {"knee_right", "shank_right", "thigh_right", "knee_left"})
      EXPECT_GT(k.height(k.time(i / 100.0), name), 0) << name << " at " << i;
}

TEST_P(EveryKneel, FeetStandOnTheGround) {
  double right = 0, left = 0, least = 1;
  for (int i = 0; i <= 200; ++i) {
    const double t = k.kneel->duration() * i / 200;
    right = std::max(right, std::abs(k.height(t, "foot_right")));
    const double low = k.height(t, "foot_left");
    least = std::min(least, low);
    const bool steps = (t > k.time(0.05) && t < k.time(0.8)) ||
                       (t > k.kneel->duration() - 0.95 * k.options.rise_s && t < k.kneel->duration());
    if (!steps) left = std::max(left, std::abs(low));
  }
  EXPECT_LT(right, 1e-7);
  EXPECT_LT(left, 1e-7);
  EXPECT_GT(least, -1e-7);
  EXPECT_NEAR(k.height(k.time(0.425), "foot_left"), 0.05, 1e-6);
  const FootReport feet = *footReport(k.human, *k.kneel);
  EXPECT_LT(feet.hover_m, 1e-7);
  EXPECT_LT(feet.slip_m, 1e-5);
}

TEST_P(EveryKneel, StandingFeetDoNotSlip) {
  const double h = 1e-5;
  double slip = 0;
  for (const char* name : {"foot_right", "foot_left"})
    for (int i = 0; i < 100; ++i) {
      const double u = (i + 0.37) / 100;
      if (name[5] == 'l' && u > 0.05 && u < 0.8) continue;
      const BodyShape& foot = k.shape(name);
      const auto at = [&](double t) { return k.poses(t)[foot.link] * foot.X_LS; };
      const Vec3 low = lowestPoint(foot.shape, at(k.time(u)).rotation);
      slip = std::max(slip, norm(at(k.time(u) + h) * low - at(k.time(u) - h) * low) / (2 * h));
    }
  EXPECT_LT(slip, 2e-4);  // the pelvis goes forward at 1 m/s
}

TEST_P(EveryKneel, LimbsStayApartAndWithinTheirLimits) {
  double legs = 1, arms = 1;
  for (int i = 0; i <= 40; ++i) {
    const double t = k.time(1) * i / 40;
    const auto X = k.poses(t);
    legs = std::min(legs, test::clearance(k.human, X, {"thigh_left", "knee_left", "shank_left", "foot_left"},
                                          {"thigh_right", "knee_right", "shank_right", "foot_right"}));
    arms = std::min(arms, test::clearance(k.human, X, {"hand", "forearm"}, {"pelvis", "waist", "chest", "thigh"}));
    const Posture p = k.kneel->at(t);
    for (std::size_t j = 0; j < p.q.size(); ++j) {
      ASSERT_GE(p.q[j], k.human.skeleton.joints[j].lower - 1e-12) << k.human.skeleton.joints[j].name << " at " << t;
      ASSERT_LE(p.q[j], k.human.skeleton.joints[j].upper + 1e-12) << k.human.skeleton.joints[j].name << " at " << t;
    }
  }
  RecordProperty("legs_mm", std::to_string(1e3 * legs));
  RecordProperty("arms_mm", std::to_string(1e3 * arms));
  EXPECT_GE(legs, 0.020);
  EXPECT_GE(arms, 0.020);
}

INSTANTIATE_TEST_SUITE_P(All, EveryKneel, testing::ValuesIn(manikinsAsked()), [](const auto& i) { return i.param; });

TEST(Kneel, VelocityIsContinuousAndZeroAtTheEnds) {
  const Kneeling k;
  const double h = 1e-5;
  std::vector<double> times;
  for (const double u : {0.0, 0.05, 0.8, 1.0}) times.push_back(k.time(u));
  times.push_back(k.time(1) + k.options.hold_s);
  for (int i = 1; i < 400; ++i) times.push_back(k.time(i / 400.0));  // nodes
  for (int i = 1; i < 300; ++i) times.push_back(k.kneel->duration() * (i + 0.123) / 300);
  double jump = 0, fastest = 0, where = 0;
  for (const double t : times) {
    const auto x = k.poses(t - h), y = k.poses(t), z = k.poses(t + h);
    for (std::size_t l = 0; l < x.size(); ++l) {
      const Vec3 tip{0.1, 0.1, 0.1};
      const Vec3 left = (y[l] * tip - x[l] * tip) / h, right = (z[l] * tip - y[l] * tip) / h;
      if (norm(right - left) > jump) jump = norm(right - left), where = t;
      fastest = std::max(fastest, norm(right));
    }
  }
  EXPECT_GT(fastest, 1);
  EXPECT_LT(jump, 2e-3 * fastest) << "at " << where;
  EXPECT_EQ(k.kneel->at(-1).q, k.kneel->at(k.options.stand_s).q);
  EXPECT_DOUBLE_EQ(k.kneel->duration(), 0.25 + 1.5 + 1 + 1.5);
}

TEST(Kneel, GetsUpTheSameWay) {
  const Kneeling k;
  for (const double u : {0.1, 0.5, 0.9}) {
    const Posture down = k.kneel->at(k.time(u)), up = k.kneel->at(k.kneel->duration() - u * k.options.rise_s);
    for (std::size_t j = 0; j < down.q.size(); ++j) EXPECT_NEAR(down.q[j], up.q[j], 1e-12);
    EXPECT_LT(norm(down.root.origin - up.root.origin), 1e-12);
  }
  KneelOptions stays;
  stays.rise_s = 0;
  const auto kneel = makeKneel(k.human, stays);
  EXPECT_DOUBLE_EQ(kneel->duration(), 2.5);
  EXPECT_EQ(kneel->at(2.5).q, k.kneel->at(k.down()).q);
}

TEST(Kneel, RefusesNonsense) {
  const Human h = makeManikin("male_p50");
  const auto with = [](auto change) {
    KneelOptions o;
    change(o);
    return o;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(makeKneel(h, with([&](KneelOptions& o) { o.stand_s = nan; })), InputError);
  EXPECT_THROW(makeKneel(h, with([&](KneelOptions& o) { o.duration_s = 0.1; })), InputError);
  EXPECT_THROW(makeKneel(h, with([&](KneelOptions& o) { o.hold_s = -1; })), InputError);
  EXPECT_THROW(makeKneel(h, with([&](KneelOptions& o) { o.rise_s = 0.1; })), InputError);
  EXPECT_THROW(makeKneel(h, with([&](KneelOptions& o) { o.rise_s = nan; })), InputError);
  Human footless = h;
  std::erase_if(footless.shapes, [](const BodyShape& s) { return s.name == "foot_left"; });
  EXPECT_THROW(makeKneel(footless, {}), InputError);
  Human hipless = h;
  hipless.skeleton.joints[hipless.skeleton.joint("hip_rotation_left")].name = "x";
  EXPECT_THROW(makeKneel(hipless, {}), InputError);
}

}  // namespace
}  // namespace gambeson
