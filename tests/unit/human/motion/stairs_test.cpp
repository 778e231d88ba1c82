#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/stairs.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/walk_curves.hpp"
#include "unit/human/manikin/clearance.hpp"
#include "unit/manikins_asked.hpp"

namespace gambeson {
namespace {

/// A manikin that climbs two strides after a quarter of a second at rest.
struct Climbing {
  explicit Climbing(const std::string& name = "male_p50") : human(makeManikin(name)) {
    options.stand_s = 0.25;
    climb = makeStairs(human, options, &velocity);
    stairs = *climb->stairs();
  }
  double periodic() const { return options.stand_s + options.lead_in_s; }
  std::vector<Pose> poses(double t) const {
    const Posture p = climb->at(t);
    return linkPoses(human.skeleton, p.q, p.root);
  }
  double q(double t, const std::string& joint) const { return climb->at(t).q.at(human.skeleton.joint(joint)); }
  Pose foot(double t, const std::string& side) const {
    const BodyShape& s = footOf(human, side, "");
    return poses(t)[s.link] * s.X_LS;
  }
  Human human;
  StairOptions options;
  Vec3 velocity;
  std::unique_ptr<Motion> climb;
  Stairs stairs;
};

class EveryClimb : public testing::TestWithParam<std::string> {
 protected:
  Climbing c{GetParam()};
};

TEST_P(EveryClimb, LimbsStayApartAndWithinTheirLimits) {
  double legs = 1, hands = 1, arms = 1;
  const int n = 96;
  for (int i = 0; i <= n; ++i) {
    const double t = c.climb->duration() * i / n;
    const auto X = c.poses(t);
    legs = std::min(legs, test::clearance(c.human, X, {"thigh_left", "knee_left", "shank_left", "foot_left"},
                                          {"thigh_right", "knee_right", "shank_right", "foot_right"}));
    hands = std::min(hands, test::clearance(c.human, X, {"hand", "forearm"}, {"pelvis", "iliac", "thigh", "knee"}));
    arms = std::min(arms, test::clearance(c.human, X, {"hand", "forearm"}, {"waist", "chest"}));
    const Posture p = c.climb->at(t);
    for (std::size_t j = 0; j < p.q.size(); ++j) {
      ASSERT_GE(p.q[j], c.human.skeleton.joints[j].lower - 1e-12) << c.human.skeleton.joints[j].name << " at " << t;
      ASSERT_LE(p.q[j], c.human.skeleton.joints[j].upper + 1e-12) << c.human.skeleton.joints[j].name << " at " << t;
    }
  }
  RecordProperty("legs_mm", std::to_string(1e3 * legs));
  RecordProperty("hands_mm", std::to_string(1e3 * hands));
  RecordProperty("arms_mm", std::to_string(1e3 * arms));
  EXPECT_GE(legs, 0.020);
  EXPECT_GE(hands, 0.060);
  EXPECT_GE(arms, 0.025);
}

// No foot enters a step, one of them always stands on one, and in the swing the foot clears the steps by a centimetre
// half way.
TEST_P(EveryClimb, FeetStandOnTheStepsAndClearThem) {
  double deepest = 1, floating = 0;
  const int n = 600;
  for (int i = 0; i <= n; ++i) {
    const double t = c.climb->duration() * i / n;
    double least = 1;
    for (const char* side : {"left", "right"})
      least = std::min(least, gapTo(footOf(c.human, side, "").shape, c.foot(t, side), c.stairs));
    deepest = std::min(deepest, least);
    floating = std::max(floating, least);
  }
  RecordProperty("deepest_mm", std::to_string(1e3 * deepest));
  EXPECT_GT(deepest, -1e-4);
  EXPECT_LT(floating, 1e-7);
  const double off = stairAscent().foot_off, middle = c.periodic() + 0.5 * (1 + off) * c.options.stride_time_s;
  EXPECT_GT(gapTo(footOf(c.human, "right", "").shape, c.foot(middle, "right"), c.stairs), 0.0099);
}

// From foot strike to foot off the foot's point on the tread is at rest, at the tread's height, in the treads' order.
TEST_P(EveryClimb, StanceFeetDoNotSlip) {
  const double T = c.options.stride_time_s, off = stairAscent().foot_off, h = 1e-5;
  double slip = 0, height = 0, before_edge = 1, riser = 1;
  for (int stance = 0; stance < 3; ++stance) {  // right on the first tread, left on the second, right on the third
    const std::string side = stance % 2 == 0 ? "right" : "left";
    const BodyShape& foot = footOf(c.human, side, "");
    const double strike = c.periodic() + 0.5 * T * stance, level = (stance + 1) * c.stairs.rise_m,
                 edge = c.stairs.first_edge_m + stance * c.stairs.tread_m;
    for (int i = 0; i <= 150; ++i) {
      const double t = strike + (i + 0.37) / 151 * std::min(off * T, c.climb->duration() - strike - 1e-4);
      const Pose X = c.foot(t, side), before = c.foot(t - h, side), after = c.foot(t + h, side);
      const Vec3 low = lowestPoint(foot.shape, X.rotation), v = (after * low - before * low) / (2 * h);
      slip = std::max(slip, norm(v));
      height = std::max(height, std::abs((X * low).z - level));
      before_edge = std::min(before_edge, (X * low).x - edge);
      riser = std::min(riser, edge + c.stairs.tread_m - (X * low).x);
    }
  }
  RecordProperty("slip_mm_s", std::to_string(1e3 * slip));
  EXPECT_LT(slip, 1e-3);  // the pelvis moves at 0.7 m/s
  EXPECT_LT(height, 1e-6);
  EXPECT_GT(before_edge, 0);
  EXPECT_GT(riser, 0);
}

// Rises of stairs lie between 0.13 and 0.22 m (building codes); shallow ones have long treads. A step is about 2 rises
// and a tread of 0.59 to 0.73 m (Blondel's rule, with room for small and tall people).
TEST_P(EveryClimb, StairsAreThoseThatPeopleClimb) {
  EXPECT_GT(c.stairs.rise_m, 0.13);
  EXPECT_LT(c.stairs.rise_m, 0.22);
  EXPECT_GT(2 * c.stairs.rise_m + c.stairs.tread_m, 0.59);
  EXPECT_LT(2 * c.stairs.rise_m + c.stairs.tread_m, 0.80);
  EXPECT_NEAR(c.velocity.x * c.options.stride_time_s, 2 * c.stairs.tread_m, 1e-9);
  EXPECT_NEAR(c.velocity.z * c.options.stride_time_s, 2 * c.stairs.rise_m, 1e-9);
  EXPECT_NEAR(c.velocity.y, 0, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(All, EveryClimb, testing::ValuesIn(manikinsAsked()), [](const auto& i) { return i.param; });

// The configuration after a stride (two steps, 1.2 s) is that at its start, two rises higher and two treads further;
// half a stride later it is the mirror image.
TEST(Climb, RepeatsUpToTheRiseAndIsMirrored) {
  const Climbing c;
  const double T = c.options.stride_time_s, t0 = c.periodic();
  for (int i = 0; i <= 40; ++i) {
    const double t = t0 + T * i / 40.0;
    const Posture a = c.climb->at(t), b = c.climb->at(t + T), half = c.climb->at(t + T / 2);
    for (std::size_t j = 0; j < a.q.size(); ++j) EXPECT_NEAR(a.q[j], b.q[j], 1e-10);
    const Vec3 on = b.root.origin - a.root.origin;
    EXPECT_NEAR(on.x, 2 * c.stairs.tread_m, 1e-9);
    EXPECT_NEAR(on.y, 0, 1e-9);
    EXPECT_NEAR(on.z, 2 * c.stairs.rise_m, 1e-9);
    EXPECT_NEAR(half.root.origin.x - a.root.origin.x, c.stairs.tread_m, 1e-8);
    EXPECT_NEAR(half.root.origin.z - a.root.origin.z, c.stairs.rise_m, 1e-8);
    for (const std::string joint : {"hip_flexion", "hip_adduction", "hip_rotation", "knee_flexion", "ankle_flexion",
                                    "shoulder_flexion", "elbow_flexion"})
      EXPECT_NEAR(c.q(t, joint + "_right"), c.q(t + T / 2, joint + "_left"), 1e-10);
    const Vec3 here = a.root.rotation * Vec3{0.3, 0.2, 0.1}, there = half.root.rotation * Vec3{0.3, -0.2, 0.1};
    EXPECT_NEAR(norm(here - Vec3{there.x, -there.y, there.z}), 0, 1e-10);
  }
}

// Hip flexion is that of the data throughout (human/data/stairs_ascent.json: highest 68.0 degrees at 94 %, 67.07 at
// foot strike, lowest 8.01 at 62 %), from the pelvis's zero of walking (-9.01 degrees).
TEST(Climb, HipsFollowTheDataExactly) {
  const Climbing c;
  const double T = c.options.stride_time_s, t0 = c.periodic(), zero = pelvisZero_deg();
  EXPECT_NEAR(zero, -9.006, 0.001);
  EXPECT_NEAR(c.q(t0 + 0.94 * T, "hip_flexion_right") / rad_per_deg, 68.0 + zero, 1e-9);
  EXPECT_NEAR(c.q(t0 + 0.44 * T, "hip_flexion_left") / rad_per_deg, 68.0 + zero, 1e-9);
  EXPECT_NEAR(c.q(t0, "hip_flexion_right") / rad_per_deg, 67.07 + zero, 1e-9);
  EXPECT_NEAR(c.q(t0 + 0.62 * T, "hip_flexion_right") / rad_per_deg, 8.01 + zero, 1e-9);
  double high = 0;
  for (int i = 0; i < 1000; ++i) high = std::max(high, c.q(t0 + T * i / 1000, "hip_flexion_right"));
  EXPECT_NEAR(high / rad_per_deg, 68.0 + zero, 0.1);
  // Knee: the data in single support; the swing's peak is raised by no more than a degree (0.3 of the lift).
  EXPECT_NEAR(c.q(t0 + 0.42 * T, "knee_flexion_right") / rad_per_deg, 17.53, 1e-6);
  EXPECT_NEAR(c.q(t0 + 0.82 * T, "knee_flexion_right") / rad_per_deg, 95.0, 1.0);
}

TEST(Climb, VelocityIsContinuous) {
  const Climbing c;
  const double h = 1e-5, T = c.options.stride_time_s, begin = c.options.stand_s, climbing = c.periodic();
  const double off = stairAscent().foot_off;
  std::vector<double> times{begin, climbing, climbing + T};
  for (int i = 0; i < 4; ++i)
    for (const double p : {0.0, 0.44, off - 0.5, off - 0.5 + 0.12, 0.28, 0.30, 0.40, 0.40 + 1e-3})
      times.push_back(climbing + T * (i / 2.0 + p));
  for (const double u : {0.7, 0.85, 0.875}) times.push_back(begin + u * c.options.lead_in_s);
  for (int i = 1; i < 100; ++i) times.push_back(climbing + T * i / 50);
  for (int i = 1; i < 400; ++i) times.push_back(c.climb->duration() * (i + 0.123) / 400);
  double jump = 0, fastest = 0, where = 0;
  for (const double t : times) {
    if (t + h > c.climb->duration()) continue;
    const auto a = c.poses(t - h), b = c.poses(t), d = c.poses(t + h);
    for (std::size_t l = 0; l < a.size(); ++l) {
      const Vec3 tip{0.1, 0.1, 0.1};
      const Vec3 left = (b[l] * tip - a[l] * tip) / h, right = (d[l] * tip - b[l] * tip) / h;
      if (norm(right - left) > jump) jump = norm(right - left), where = t;
      fastest = std::max(fastest, norm(right));
    }
  }
  EXPECT_GT(fastest, 2);
  EXPECT_LT(jump, 2e-3 * fastest) << "at " << where;
}

TEST(Climb, StartsAtRestOnTheGround) {
  const Climbing c;
  const Posture stand = standing(c.human);
  for (const double t : {-1.0, 0.0, 0.1, 0.25}) {
    EXPECT_EQ(c.climb->at(t).q, stand.q);
    EXPECT_NEAR(norm(c.climb->at(t).root.origin - stand.root.origin), 0, 1e-12);
  }
  EXPECT_DOUBLE_EQ(c.climb->duration(), 0.25 + 0.6 + 2 * 1.2);
  EXPECT_DOUBLE_EQ(c.options.measuredFrom_s(), 0.25 + 0.6 + 1.2);
  EXPECT_EQ(c.climb->at(99).q, c.climb->at(c.climb->duration()).q);
}

TEST(Climb, RefusesNonsense) {
  const Human h = makeManikin("male_p50");
  const auto with = [](auto change) {
    StairOptions o;
    change(o);
    return o;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(makeStairs(h, with([&](StairOptions& o) { o.stand_s = nan; })), InputError);
  EXPECT_THROW(makeStairs(h, with([&](StairOptions& o) { o.lead_in_s = 0.1; })), InputError);
  EXPECT_THROW(makeStairs(h, with([&](StairOptions& o) { o.lead_in_s = nan; })), InputError);
  EXPECT_THROW(makeStairs(h, with([&](StairOptions& o) { o.strides = 0; })), InputError);
  EXPECT_THROW(makeStairs(h, with([&](StairOptions& o) { o.lead_in_strides = 2; })), InputError);
  EXPECT_THROW(makeStairs(h, with([&](StairOptions& o) { o.stride_time_s = nan; })), InputError);
  Human footless = h;
  std::erase_if(footless.shapes, [](const BodyShape& s) { return s.name == "foot_left"; });
  EXPECT_THROW(makeStairs(footless, {}), InputError);
  Human kneeless = h;
  kneeless.skeleton.joints[kneeless.skeleton.joint("knee_flexion_left")].name = "x";
  EXPECT_THROW(makeStairs(kneeless, {}), InputError);
}

// A sphere of radius r beside, above and at the edge of a step of height 0.2 that starts at x = 1.
TEST(Ground, GapToStairs) {
  const Stairs s{0.2, 0.3, 1.0};
  const Shape ball = Ellipsoid{{0.05, 0.05, 0.05}};
  const auto gap = [&](double x, double z, int* k = nullptr) { return gapTo(ball, {{}, {x, 0, z}}, s, k); };
  int nearest = -1;
  EXPECT_NEAR(gap(0.5, 0.10, &nearest), 0.05, 1e-12);  // over the ground
  EXPECT_EQ(nearest, 0);
  EXPECT_NEAR(gap(0.92, 0.15, &nearest), 0.03, 1e-12);  // before the riser
  EXPECT_EQ(nearest, 1);
  EXPECT_NEAR(gap(1.1, 0.28), 0.03, 1e-12);              // over the first tread
  EXPECT_NEAR(gap(0.94, 0.28), 0.05, 5e-5);              // off the edge: hypot(0.06, 0.08) - 0.05
  EXPECT_NEAR(gap(1.1, 0.21), -0.04, 1e-12);             // in the first tread
  EXPECT_NEAR(gap(1.35, 0.43, &nearest), -0.02, 1e-12);  // in the second
  EXPECT_EQ(nearest, 2);
  EXPECT_NEAR(gapTo(ball, {{}, {5, 0, 0.10}}, std::nullopt), 0.05, 1e-12);
  EXPECT_EQ(s.heightAt(0.99), 0);
  EXPECT_NEAR(s.heightAt(1.35), 0.4, 1e-12);
}

}  // namespace
}  // namespace gambeson
