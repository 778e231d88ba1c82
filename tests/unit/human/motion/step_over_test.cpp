#include "human/motion/step_over.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.hpp"
#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/foot_report.hpp"
#include "human/motion/leg.hpp"
#include "human/motion/standing.hpp"
#include "unit/human/manikin/clearance.hpp"
#include "unit/manikins_asked.hpp"

namespace gambeson {
namespace {

/// A manikin that steps over an obstacle of 0.5 m, or the highest that legs of small women leave room for (to a
/// centimetre), with the feet's ellipsoids.
struct Stepping {
  explicit Stepping(const std::string& name) : human(makeManikin(name)) {
    if (name == "female_p5") options.height_m = 0.44;
    if (name == "female_p50") options.height_m = 0.46;
    motion = makeStepOver(human, options, &hurdle);
  }
  std::vector<Pose> poses(double t) const {
    const Posture p = motion->at(t);
    return linkPoses(human.skeleton, p.q, p.root);
  }
  Pose foot(double t, const std::string& side) const {
    const BodyShape& s = footOf(human, side, "");
    return poses(t)[s.link] * s.X_LS;
  }
  double height(double t, const std::string& side) const {
    return gapTo(footOf(human, side, "").shape, foot(t, side), std::nullopt);
  }
  Human human;
  StepOverOptions options;
  Hurdle hurdle;
  std::unique_ptr<Motion> motion;
};

/// Each is made once.
const Stepping& stepping(const std::string& name) {
  static std::map<std::string, Stepping> made;
  return made.try_emplace(name, name).first->second;
}

class EveryStepOver : public testing::TestWithParam<std::string> {
 protected:
  const Stepping& s = stepping(GetParam());
};

// Man 2006, 5.4: an obstacle 0.5 m high. The distance of the foot's ellipsoid from it, over the whole motion, is at
// least 20 mm, and is not needlessly large.
TEST_P(EveryStepOver, FeetClearTheObstacle) {
  for (const std::string side : {"right", "left"}) {
    const Shape& shape = footOf(s.human, side, "").shape;
    double gap = 1, over = 0;
    constexpr int n = 2000;
    for (int i = 0; i <= n; ++i) {
      const Pose X = s.foot(s.motion->duration() * i / n, side);
      if (std::abs(X.origin.x - s.hurdle.front_m) > 0.5) continue;
      gap = std::min(gap, gapToHurdle(shape, X, s.hurdle));
      if (std::abs(X.origin.x - s.hurdle.front_m) < 0.1) over = std::max(over, X.origin.z);
    }
    RecordProperty(side + "_mm", std::to_string(1e3 * gap));
    EXPECT_GE(gap, 0.020) << side;
    EXPECT_GE(gap, s.options.clearance_m) << side;
    EXPECT_LT(gap, 0.040) << side;
    EXPECT_GT(over, s.hurdle.height_m) << side;  // above it, not around it
  }
  EXPECT_EQ(s.hurdle.height_m, s.options.height_m);
  EXPECT_EQ(s.hurdle.depth_m, 0.05);
}

// Thighs, knees and shanks keep out of it (human/DECISIONS.md).
TEST_P(EveryStepOver, LegsKeepOutOfTheObstacle) {
  const std::map<std::string, double> least_m{{"male_p5", -0.001},   {"male_p50", 0.015},    {"male_p95", 0.025},
                                              {"female_p5", -0.002}, {"female_p50", -0.002}, {"female_p95", 0}};
  double gap = 1;
  constexpr int n = 600;
  for (int i = 0; i <= n; ++i) {
    const std::vector<Pose> X = s.poses(s.motion->duration() * i / n);
    for (const BodyShape& shape : s.human.shapes) {
      const Pose at = X[shape.link] * shape.X_LS;
      if (at.origin.z < 1.1 && std::abs(at.origin.x - s.hurdle.front_m) < 0.5)
        gap = std::min(gap, gapToHurdle(shape.shape, at, s.hurdle));
    }
  }
  RecordProperty("legs_mm", std::to_string(1e3 * gap));
  EXPECT_GE(gap, least_m.at(GetParam()));
}

// Four strides: each foot is lifted four times; before the obstacle twice, after it once. All begins and ends standing.
TEST_P(EveryStepOver, TakesFourStridesTheThirdOverTheObstacle) {
  for (const std::string side : {"right", "left"}) {
    int steps = 0, before = 0;
    bool up = false;
    for (int i = 0; i <= 2000; ++i) {
      const double t = s.motion->duration() * i / 2000;
      const bool now = s.height(t, side) > 0.005;
      if (now && !up) {
        ++steps;
        if (s.foot(t, side).origin.x < s.hurdle.front_m) ++before;
      }
      up = now;
    }
    EXPECT_EQ(steps, 4) << side;
    EXPECT_EQ(before, 3) << side;
  }
  const Posture stands = standing(s.human);
  for (const double t : {0.0, s.motion->duration()}) {
    const Posture p = s.motion->at(t);
    for (std::size_t j = 0; j < p.q.size(); ++j)
      EXPECT_NEAR(p.q[j], stands.q[j], 1e-4) << s.human.skeleton.joints[j].name << " at " << t;
    EXPECT_NEAR(p.root.origin.z, stands.root.origin.z, 1e-7);
  }
}

TEST_P(EveryStepOver, FeetThatStandNeitherSinkNorSlip) {
  const FootReport feet = *footReport(s.human, *s.motion);
  EXPECT_LT(feet.slip_m_per_s, 1e-3);  // the pelvis goes at 1 m/s
  EXPECT_LT(feet.slip_m, 1e-4);
  EXPECT_LT(feet.penetration_m, 1e-6);
  EXPECT_LT(feet.hover_m, 1e-6);  // one foot always stands
  // Beside both ends of a swing, where it is lifted by less than what is looked at.
  for (int i = 1; i < 400; ++i) {
    const double t = s.motion->duration() * i / 400, h = 1e-4;
    for (const std::string side : {"right", "left"}) {
      EXPECT_GT(s.height(t, side), -1e-6) << side << " at " << t;
      const Pose a = s.foot(t - h, side), b = s.foot(t + h, side);
      const Vec3 low = lowestPoint(footOf(s.human, side, "").shape, s.foot(t, side).rotation);
      const double speed = norm(b * low - a * low) / (2 * h);
      const bool stands = std::max({s.height(t - 0.01, side), s.height(t, side), s.height(t + 0.01, side)}) < 1e-6;
      if (stands) {
        EXPECT_LT(speed, 1e-3) << side << " at " << t;
      }
    }
  }
}

TEST_P(EveryStepOver, LimbsStayApartAndWithinTheirLimits) {
  double legs = 1, arms = 1;
  constexpr int n = 150;
  for (int i = 0; i <= n; ++i) {
    const double t = s.motion->duration() * i / n;
    const auto X = s.poses(t);
    legs = std::min(legs, test::clearance(s.human, X, {"thigh_left", "knee_left", "shank_left", "foot_left"},
                                          {"thigh_right", "knee_right", "shank_right", "foot_right"}));
    if (i % 3 == 0)
      arms = std::min(arms, test::clearance(s.human, X, {"hand", "forearm"}, {"pelvis", "iliac", "thigh", "knee"}));
    const Posture p = s.motion->at(t);
    for (std::size_t j = 0; j < p.q.size(); ++j) {
      ASSERT_GE(p.q[j], s.human.skeleton.joints[j].lower - 1e-9) << s.human.skeleton.joints[j].name << " at " << t;
      ASSERT_LE(p.q[j], s.human.skeleton.joints[j].upper + 1e-9) << s.human.skeleton.joints[j].name << " at " << t;
    }
  }
  RecordProperty("legs_mm", std::to_string(1e3 * legs));
  RecordProperty("arms_mm", std::to_string(1e3 * arms));
  EXPECT_GE(legs, 0.020);
  EXPECT_GE(arms, 0.020);
}

INSTANTIATE_TEST_SUITE_P(All, EveryStepOver, testing::ValuesIn(manikinsAsked()), [](const auto& i) { return i.param; });

TEST(StepOver, VelocityIsContinuousAndZeroAtTheEnds) {
  const Stepping& s = stepping("male_p50");
  const double h = 1e-5, T = s.motion->duration();
  const int nodes = static_cast<int>(std::ceil(T / 0.0025));
  std::vector<double> times{0, T, s.options.stand_s};
  for (int i = 1; i < nodes; i += 3) times.push_back(T * i / nodes);
  for (int i = 1; i < 500; ++i) times.push_back(T * (i + 0.123) / 500);
  double jump = 0, fastest = 0, where = 0;
  for (const double t : times) {
    const auto x = s.poses(t - h), y = s.poses(t), z = s.poses(t + h);
    for (std::size_t l = 0; l < x.size(); ++l) {
      const Vec3 tip{0.1, 0.1, 0.1};
      const Vec3 left = (y[l] * tip - x[l] * tip) / h, right = (z[l] * tip - y[l] * tip) / h;
      if (norm(right - left) > jump) jump = norm(right - left), where = t;
      fastest = std::max(fastest, norm(right));
    }
  }
  EXPECT_GT(fastest, 2);
  EXPECT_LT(jump, 2e-3 * fastest) << "at " << where;
  EXPECT_EQ(s.motion->at(-1).q, s.motion->at(0).q);
  EXPECT_EQ(s.motion->at(99).q, s.motion->at(T).q);
}

// A stride on the level is a step length of 0.72 of the leg for each foot, and the next is like it.
TEST(StepOver, StridesOnTheLevelRepeat) {
  const Human human = makeManikin("male_p50");
  StepOverOptions o;
  o.before = 4;
  o.height_m = 0.2;
  Hurdle far;
  const auto motion = makeStepOver(human, o, &far);
  const double first = o.stand_s + 0.4 + (0.23 + 0.38) * o.stride_time_s;  // the right foot's first landing
  for (const double u : {0.2, 0.5, 0.8}) {
    const double t = first + (0.5 + u) * o.stride_time_s;
    const Posture a = motion->at(t), b = motion->at(t + o.stride_time_s);
    for (std::size_t j = 0; j < a.q.size(); ++j)
      EXPECT_NEAR(a.q[j], b.q[j], 0.01) << human.skeleton.joints[j].name << " at " << u;
    const double leg = norm(human.skeleton.joints[human.skeleton.joint("knee_flexion_right")].X_PJ.origin) +
                       norm(human.skeleton.joints[human.skeleton.joint("ankle_flexion_right")].X_PJ.origin);
    EXPECT_NEAR(b.root.origin.x - a.root.origin.x, 2 * 0.72 * leg, 1e-3);
  }
}

// Lower obstacles ask for less: hips and knees bend less the lower it is.
TEST(StepOver, BendsNoMoreThanItMust) {
  const Human human = makeManikin("female_p5");
  double hip_before = 3, knee_before = 3;
  for (const double height : {0.44, 0.3, 0.1}) {
    StepOverOptions o;
    o.height_m = height;
    Hurdle hurdle;
    const auto motion = makeStepOver(human, o, &hurdle);
    double hip = 0, knee = 0, gap = 1;
    for (int i = 0; i <= 1000; ++i) {
      const Posture p = motion->at(motion->duration() * i / 1000);
      hip = std::max(hip, p.q[human.skeleton.joint("hip_flexion_right")]);
      knee = std::max(knee, p.q[human.skeleton.joint("knee_flexion_left")]);
      const auto X = linkPoses(human.skeleton, p.q, p.root);
      for (const char* side : {"right", "left"}) {
        const BodyShape& foot = footOf(human, side, "");
        gap = std::min(gap, gapToHurdle(foot.shape, X[foot.link] * foot.X_LS, hurdle));
      }
    }
    EXPECT_GE(gap, o.clearance_m) << height;
    EXPECT_LT(hip, hip_before) << height;
    EXPECT_LT(knee, knee_before) << height;
    hip_before = hip, knee_before = knee;
  }
}

// Quicker or slower, it is the same motion, but for the time in which knees bend from standing and for the pelvis's
// height: it is smoothed over whole instants, and its limit jumps by 4 mm where a foot is lifted.
TEST(StepOver, KeepsItsShapeAtAnyPace) {
  const Human human = makeManikin("male_p5");
  StepOverOptions slow, quick;
  slow.stride_time_s = 2, quick.stride_time_s = 0.8;
  slow.stand_s = quick.stand_s = 0;
  const auto a = makeStepOver(human, slow), b = makeStepOver(human, quick);
  for (int i = 1; i < 20; ++i) {
    const double u = 0.7 + 4.8 * i / 20;  // from the first step's end on: the pelvis turns from standing before
    const Posture p = a->at(0.4 + u * slow.stride_time_s), q = b->at(0.4 + u * quick.stride_time_s);
    for (const char* joint : {"hip_flexion_right", "knee_flexion_right", "hip_flexion_left", "knee_flexion_left"}) {
      const int j = human.skeleton.joint(joint);
      EXPECT_NEAR(p.q[j], q.q[j], 0.02) << joint << " at " << u;
    }
    EXPECT_NEAR(p.root.origin.x, q.root.origin.x, 1e-3) << u;
    EXPECT_NEAR(p.root.origin.z, q.root.origin.z, 4e-3) << u;
  }
}

// Whoever cannot is told which height they can, and steps over that.
TEST(StepOver, SaysTheLargestHeight) {
  const Human human = makeManikin("female_p50");
  StepOverOptions o;
  try {
    makeStepOver(human, o);
    ADD_FAILURE() << "0.5 m is 0.65 of her legs";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "height");
    const std::string said = e.reason(), before = "allowed: up to ";
    ASSERT_NE(said.find(before), std::string::npos) << said;
    o.height_m = std::stod(said.substr(said.find(before) + before.size()));
    EXPECT_GT(o.height_m, 0.44);
    EXPECT_LT(o.height_m, 0.5);
    EXPECT_NO_THROW(makeStepOver(human, o));
  }
}

// Ankles that bend less than our men's would not bear their steps.
TEST(StepOver, StiffAnklesTakeShorterSteps) {
  Human human = makeManikin("male_p50");
  for (Joint& joint : human.skeleton.joints)
    if (joint.name.starts_with("ankle_flexion")) joint.upper = 26 * rad_per_deg;
  StepOverOptions options;
  options.height_m = 0.15;
  Hurdle hurdle;
  const auto motion = makeStepOver(human, options, &hurdle);
  const auto poses = [&](double t) {
    const Posture p = motion->at(t);
    return linkPoses(human.skeleton, p.q, p.root);
  };
  double gap = 1;
  for (double t = 0; t < motion->duration(); t += 0.01) {
    const std::vector<Pose> X = poses(t);
    for (const std::string side : {"right", "left"}) {
      const BodyShape& foot = footOf(human, side, "");
      gap = std::min(gap, gapToHurdle(foot.shape, X[static_cast<std::size_t>(foot.link)] * foot.X_LS, hurdle));
    }
    for (std::size_t j = 0; j < human.skeleton.joints.size(); ++j) {
      const Joint& joint = human.skeleton.joints[j];
      const double q = motion->at(t).q[j];
      EXPECT_TRUE(q > joint.lower - 1e-6 && q < joint.upper + 1e-6) << joint.name << " at " << t;
    }
  }
  EXPECT_GT(gap, options.clearance_m);
  const auto wayOf = [&](const Human& h, const Motion& m) {
    const double leg = legOf(h, "left", "").length_m();
    return (m.at(m.duration()).root.origin.x - m.at(0).root.origin.x) / leg;
  };
  const Human man = makeManikin("male_p50");
  EXPECT_LT(wayOf(human, *motion), 0.99 * wayOf(man, *makeStepOver(man, options, nullptr)));
}

TEST(StepOver, RefusesNonsense) {
  const Human h = makeManikin("male_p50");
  const auto keyOf = [&](const Human& human, auto change) -> std::string {
    StepOverOptions o;
    change(o);
    try {
      makeStepOver(human, o);
    } catch (const InputError& e) {
      return e.where().key;
    }
    return "nothing";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(keyOf(h, [&](StepOverOptions& o) { o.stand_s = nan; }), "stand_s");
  EXPECT_EQ(keyOf(h, [&](StepOverOptions& o) { o.before = 0; }), "before");
  EXPECT_EQ(keyOf(h, [&](StepOverOptions& o) { o.after = 0; }), "after");
  EXPECT_EQ(keyOf(h, [&](StepOverOptions& o) { o.height_m = nan; }), "height");
  EXPECT_EQ(keyOf(h, [&](StepOverOptions& o) { o.depth_m = -1; }), "depth");
  EXPECT_EQ(keyOf(h, [&](StepOverOptions& o) { o.clearance_m = nan; }), "clearance");
  EXPECT_EQ(keyOf(h, [&](StepOverOptions& o) { o.stride_time_s = 0; }), "stride_time_s");
  EXPECT_EQ(keyOf(makeManikin("female_p5"), [&](StepOverOptions& o) { o.height_m = 0.7; }), "height");
  Human footless = h;
  std::erase_if(footless.shapes, [](const BodyShape& s) { return s.name == "foot_left"; });
  EXPECT_EQ(keyOf(footless, [](StepOverOptions&) {}), "human");
}

TEST(Hurdle, IsAsFarAsItIs) {
  const Hurdle hurdle{1, 0.1, 0.5};
  const Shape ball = Ellipsoid{{0.05, 0.05, 0.05}};
  const auto gap = [&](double x, double z) { return gapToHurdle(ball, Pose{{}, {x, 3, z}}, hurdle); };
  EXPECT_NEAR(gap(1.05, 0.7), 0.15, 1e-12);                       // above
  EXPECT_NEAR(gap(0.8, 0.2), 0.15, 1e-12);                        // before
  EXPECT_NEAR(gap(1.3, 0.2), 0.15, 1e-12);                        // behind
  EXPECT_NEAR(gap(0.8, 0.6), std::hypot(0.2, 0.1) - 0.05, 1e-5);  // off the front edge
  EXPECT_NEAR(gap(1.2, 0.7), std::hypot(0.1, 0.2) - 0.05, 1e-5);  // off the rear edge
  EXPECT_NEAR(gap(1.02, 0.2), -(0.02 + 0.05), 1e-12);             // in it: out at the front
}

}  // namespace
}  // namespace gambeson
