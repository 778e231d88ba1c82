#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/walk.hpp"
#include "human/motion/walk_curves.hpp"
#include "unit/human/manikin/clearance.hpp"
#include "unit/manikins_asked.hpp"

namespace gambeson {
namespace {

/// A manikin with two strides after half a second at rest and half a second of lead-in.
struct Walking {
  explicit Walking(const std::string& name = "male_p50") : human(makeManikin(name)) {
    options.stand_s = 0.25;
    walk = makeWalk(human, options, &velocity);
  }
  double periodic() const { return options.stand_s + options.lead_in_s; }
  std::vector<Pose> poses(double t) const {
    const Posture p = walk->at(t);
    return linkPoses(human.skeleton, p.q, p.root);
  }
  double q(double t, const std::string& joint) const { return walk->at(t).q.at(human.skeleton.joint(joint)); }
  Human human;
  WalkOptions options;
  Vec3 velocity;
  std::unique_ptr<Motion> walk;
};

class EveryWalk : public testing::TestWithParam<std::string> {
 protected:
  Walking w{GetParam()};
};

TEST_P(EveryWalk, LimbsStayApartAndWithinTheirLimits) {
  double legs = 1, arms = 1;
  const int n = 240;
  for (int i = 0; i <= n; ++i) {
    const double t = w.walk->duration() * i / n;
    const auto X = w.poses(t);
    legs = std::min(legs, test::clearance(w.human, X, {"thigh_left", "knee_left", "shank_left", "foot_left"},
                                          {"thigh_right", "knee_right", "shank_right", "foot_right"}));
    arms = std::min(arms, test::clearance(w.human, X, {"hand", "forearm"}, {"pelvis", "iliac", "thigh"}));
    const Posture p = w.walk->at(t);
    for (std::size_t j = 0; j < p.q.size(); ++j) {
      ASSERT_GE(p.q[j], w.human.skeleton.joints[j].lower - 1e-12) << w.human.skeleton.joints[j].name << " at " << t;
      ASSERT_LE(p.q[j], w.human.skeleton.joints[j].upper + 1e-12) << w.human.skeleton.joints[j].name << " at " << t;
    }
  }
  RecordProperty("legs_mm", std::to_string(1e3 * legs));
  RecordProperty("arms_mm", std::to_string(1e3 * arms));
  EXPECT_GE(legs, 0.020);
  EXPECT_GE(arms, 0.060);
}

INSTANTIATE_TEST_SUITE_P(All, EveryWalk, testing::ValuesIn(manikinsAsked()), [](const auto& i) { return i.param; });

// One-sided difference quotients either side of an instant: a smooth curve has them equal to a h, 1e-5 s times some 100
// m/s².
TEST(Walk, VelocityIsContinuous) {
  const Walking w;
  const double h = 1e-5, T = w.options.stride_time_s, begin = w.options.stand_s, walking = w.periodic();
  const double d = naturalWalk().double_support;
  std::vector<double> times{begin, walking, walking + T};
  for (int i = 0; i < 4; ++i)
    times.insert(times.end(), {walking + T * i / 2, walking + T * (i / 2.0 + d)});        // foot strike, foot off
  for (int i = 1; i < 100; ++i) times.push_back(walking + T * i / 50);                    // spline knots
  for (int i = 1; i < 400; ++i) times.push_back(w.walk->duration() * (i + 0.123) / 400);  // anywhere
  for (int i = 1; i < 250; ++i) times.push_back(begin + 0.002 * i);                       // nodes of the path
  double jump = 0, fastest = 0;
  for (const double t : times) {
    if (t + h > w.walk->duration()) continue;
    const auto a = w.poses(t - h), b = w.poses(t), c = w.poses(t + h);
    for (std::size_t l = 0; l < a.size(); ++l) {
      const Vec3 tip{0.1, 0.1, 0.1};  // off the origin, so that turning counts
      const Vec3 left = (b[l] * tip - a[l] * tip) / h, right = (c[l] * tip - b[l] * tip) / h;
      jump = std::max(jump, norm(right - left));
      fastest = std::max(fastest, norm(right));
    }
  }
  EXPECT_GT(fastest, 3);
  EXPECT_LT(jump, 1e-3 * fastest);
}

TEST(Walk, StartsAtRestAndHoldsItsEnds) {
  const Walking w;
  const Posture stand = standing(w.human);
  for (const double t : {-1.0, 0.0, 0.1, 0.25}) EXPECT_EQ(w.walk->at(t).q, stand.q);
  EXPECT_NEAR(norm(w.walk->at(0.2).root.origin - stand.root.origin), 0, 1e-12);
  EXPECT_DOUBLE_EQ(w.walk->duration(), 0.25 + 0.5 + 2 * 1.10);
  EXPECT_EQ(w.walk->at(99).q, w.walk->at(w.walk->duration()).q);
}

TEST(Walk, RepeatsAndIsMirroredHalfAStrideLater) {
  const Walking w;
  const double T = w.options.stride_time_s, t0 = w.periodic();
  double middle = 0;  // lateral
  for (int i = 0; i < 200; ++i) middle += w.walk->at(t0 + T * i / 200).root.origin.y / 200;
  for (int i = 0; i < 40; ++i) {
    const double t = t0 + T * i / 40.0;
    const Posture a = w.walk->at(t), b = w.walk->at(t + T), c = w.walk->at(t + T / 2);
    for (std::size_t j = 0; j < a.q.size(); ++j) EXPECT_NEAR(a.q[j], b.q[j], 1e-10);
    EXPECT_NEAR(norm(b.root.origin - a.root.origin - T * w.velocity), 0, 1e-9);
    for (const std::string joint : {"hip_flexion", "hip_adduction", "hip_rotation", "knee_flexion", "ankle_flexion",
                                    "shoulder_flexion", "elbow_flexion"})
      EXPECT_NEAR(w.q(t, joint + "_right"), w.q(t + T / 2, joint + "_left"), 1e-10);
    // Mirror in the plane x-z: M R M, M = diag(1, -1, 1).
    const Vec3 p{0.3, 0.2, 0.1}, m{0.3, -0.2, 0.1};
    const Vec3 here = a.root.rotation * p, there = c.root.rotation * m;
    EXPECT_NEAR(norm(here - Vec3{there.x, -there.y, there.z}), 0, 1e-10);
    EXPECT_NEAR(c.root.origin.z, a.root.origin.z, 1e-10);
    EXPECT_NEAR(c.root.origin.y - middle, -(a.root.origin.y - middle), 1e-6);
    EXPECT_NEAR(c.root.origin.x - a.root.origin.x, w.velocity.x * T / 2, 1e-8);
  }
}

// In single support the material point of the foot at the ground is at rest and at z = 0.
TEST(Walk, StanceFootRollsWithoutSlip) {
  const Walking w;
  const double T = w.options.stride_time_s, d = naturalWalk().double_support, h = 1e-5;
  double slip = 0, gap = 0, slip_double = 0, sink = 0;
  for (int i = 0; i < 200; ++i) {
    const double phase = i / 200.0, t = w.periodic() + T * (0.5 + phase) + 1e-4;
    const double p = std::fmod(0.5 + phase + 1e-4 / T, 1.0);
    const auto X = w.poses(t), before = w.poses(t - h), after = w.poses(t + h);
    sink = std::min(sink, lowestHeight(w.human, X));
    for (const BodyShape& s : w.human.shapes) {
      if (!s.name.starts_with("foot_")) continue;
      const double own = s.name == "foot_right" ? p : std::fmod(p + 0.5, 1.0);  // phase since its own strike
      if (own > 0.5 + d) continue;
      const Vec3 low = lowestPoint(s.shape, (X[s.link] * s.X_LS).rotation);
      const Vec3 v = (after[s.link] * s.X_LS * low - before[s.link] * s.X_LS * low) / (2 * h);
      const bool single = own > d && own < 0.5;
      (single ? slip : slip_double) = std::max(single ? slip : slip_double, std::hypot(v.x, v.y));
      if (single) gap = std::max(gap, std::abs((X[s.link] * s.X_LS * low).z));
    }
  }
  RecordProperty("slip_in_double_support_m_s", std::to_string(slip_double));
  RecordProperty("sink_mm", std::to_string(1e3 * sink));
  EXPECT_LT(slip, 2e-5);  // of 1.3 m/s
  EXPECT_LT(gap, 1e-12);
  EXPECT_GT(sink, -0.012);  // the mean curves of the two feet disagree by that much in double support
}

// Bovi et al. 2011, natural speed: 71.4 +- 10.2 percent of stature per second. Vertical excursion of the pelvis at this
// speed is 3 to 6 cm (Gard et al. 2004; Whittle 1997).
TEST(Walk, SpeedAndExcursionAreThoseOfPeople) {
  const Walking w;
  EXPECT_NEAR(w.velocity.x, 0.71358 * w.human.stature_m, 0.102335 * w.human.stature_m);
  EXPECT_GT(w.velocity.x, 1.2);
  EXPECT_LT(w.velocity.x, 1.4);
  EXPECT_NEAR(w.velocity.y, 0, 1e-9);
  EXPECT_EQ(w.velocity.z, 0);
  double low = 9, high = 0, low_t = 0;
  for (int i = 0; i < 200; ++i) {
    const double z = w.walk->at(w.periodic() + w.options.stride_time_s * i / 200).root.origin.z;
    if (z < low) low = z, low_t = i / 200.0;
    high = std::max(high, z);
  }
  EXPECT_GT(high - low, 0.030);
  EXPECT_LT(high - low, 0.060);
  EXPECT_LT(std::min({std::abs(low_t), std::abs(low_t - 0.5), std::abs(low_t - 1)}), 0.08);  // lowest in double support
}

// The curves at the knots: the closed data of human/data/walk_natural.json.
TEST(Walk, JointsFollowTheData) {
  const WalkCurves c = naturalWalk();
  // Row 36 %: knee 63.38 at 72 %; closure -0.93 over the cycle about its middle: 63.38 + 0.93 (0.72 - 0.5).
  EXPECT_NEAR(c.knee_flexion.at(0.72) / rad_per_deg, 63.38 + 0.93 * (0.72 - 0.5), 1e-9);
  EXPECT_NEAR(c.ankle_flexion.at(0.64) / rad_per_deg, -18.89 - 0.03 * (0.64 - 0.5), 1e-9);
  EXPECT_NEAR(c.hip_flexion.at(0.0) / rad_per_deg, 33.0 - 0.97 / 2 - 9.0, 0.2);  // mean tilt about -9.0
  EXPECT_GT(c.pelvis_yaw.at(0.0), 3 * rad_per_deg);                              // right side forward at right strike
  EXPECT_LT(c.pelvis_roll.at(0.14), -3 * rad_per_deg);                           // right side up in right stance
  EXPECT_NEAR(c.double_support, 0.1263, 1e-9);
}

TEST(Walk, StartsTheStrideAtRightFootStrike) {
  const Walking w;
  EXPECT_NEAR(w.q(w.periodic(), "hip_flexion_right"), naturalWalk().hip_flexion.at(0), 1e-12);
  EXPECT_NEAR(w.q(w.periodic(), "knee_flexion_left"), naturalWalk().knee_flexion.at(0.5), 1e-12);
}

// Three paces (Zheng 6.4): a stride and a half, the same way.
TEST(Walk, TakesPaces) {
  const Human h = makeManikin("male_p50");
  WalkOptions strides, paces;
  strides.strides = 3;
  paces.paces = 3;
  const auto a = makeWalk(h, strides), b = makeWalk(h, paces);
  EXPECT_DOUBLE_EQ(b->duration(), 0.5 + 1.5 * 1.10);
  for (int i = 0; i <= 50; ++i) {
    const double t = b->duration() * i / 50;
    EXPECT_EQ(a->at(t).q, b->at(t).q);
    EXPECT_EQ(a->at(t).root, b->at(t).root);
  }
}

TEST(Walk, RefusesNonsense) {
  const Human h = makeManikin("male_p50");
  const auto with = [](auto change) {
    WalkOptions o;
    change(o);
    return o;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(makeWalk(h, with([&](WalkOptions& o) { o.stand_s = nan; })), InputError);
  EXPECT_THROW(makeWalk(h, with([&](WalkOptions& o) { o.lead_in_s = 0; })), InputError);
  EXPECT_THROW(makeWalk(h, with([&](WalkOptions& o) { o.lead_in_s = nan; })), InputError);
  EXPECT_THROW(makeWalk(h, with([&](WalkOptions& o) { o.strides = 0; })), InputError);
  EXPECT_THROW(makeWalk(h, with([&](WalkOptions& o) { o.paces = -1; })), InputError);
  EXPECT_THROW(makeWalk(h, with([&](WalkOptions& o) { o.stride_time_s = 1e9; })), InputError);
  Human footless = h;
  std::erase_if(footless.shapes, [](const BodyShape& s) { return s.name == "foot_left"; });
  EXPECT_THROW(makeWalk(footless, {}), InputError);
  Human kneeless = h;
  kneeless.skeleton.joints[kneeless.skeleton.joint("knee_flexion_left")].name = "x";
  EXPECT_THROW(makeWalk(kneeless, {}), InputError);
}

}  // namespace
}  // namespace gambeson
