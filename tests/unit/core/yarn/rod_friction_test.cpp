#include "core/yarn/rod_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/yarn/rod.hpp"

namespace gambeson {
namespace {

constexpr double kStiffness = 3;

struct Two {
  Pose first, second;
};
Two crossed() {
  const Mat3 tilted = turned({}, {0.2, -0.3, 0.1});
  return {{tilted, {0.02, -0.01, 0.3}}, {turned(tilted, {0.1, 0.2, 1.4}), {-0.03, 0.04, 0.02}}};
}
/// Block b (x1, turn1, x2, turn2) along c.
Two moved(Two at, int b, int c, double by) {
  Vec3 way{};
  way[c] = by;
  Pose& p = b < 2 ? at.first : at.second;
  if (b % 2 == 0)
    p.origin += way;
  else
    p.rotation = turned(p.rotation, way);
  return at;
}

/// Unknowns i and j of the twelve by a and b. Turns of one section are one exponential: by themselves they do not
/// commute.
Two movedTwice(Two at, int i, double a, int j, double b) {
  Vec3 turn[2]{};
  for (const auto& [k, by] : {std::pair{i, a}, {j, b}}) {
    if (k / 3 % 2 == 0)
      at = moved(at, k / 3, k % 3, by);
    else
      turn[k / 6][k % 3] += by;
  }
  at.first.rotation = turned(at.first.rotation, turn[0]);
  at.second.rotation = turned(at.second.rotation, turn[1]);
  return at;
}

/// Sections that have moved and turned since they were gripped, the spring sticking and sliding.
TEST(RodFriction, ForcesAndTangentAreDerivatives) {
  const Two before = crossed();
  const RodGrip grip = gripBetween(before.first, before.second, {0.01, 0.02, 0.005});
  Two here = before;
  here.first.origin += Vec3{0.05, -0.03, -0.04};
  here.first.rotation = turned(here.first.rotation, {0.3, 0.1, -0.2});
  here.second.rotation = turned(here.second.rotation, {-0.2, 0.15, 0.25});
  for (const double limit : {10.0, 0.05}) {
    const auto at = [&](const Two& p, bool tangent) {
      return evaluateRodFriction(grip, p.first, p.second, kStiffness, limit, tangent);
    };
    ASSERT_EQ(stickSlip(kStiffness, limit, norm(slipOf(grip, here.first, here.second).slip)).slides, limit < 1);
    const RodFrictionAnswer answer = at(here, true);
    const double h = 1e-5;
    for (int i = 0; i < 12; ++i) {
      const RodFrictionAnswer up = at(moved(here, i / 3, i % 3, h), false),
                              down = at(moved(here, i / 3, i % 3, -h), false);
      EXPECT_NEAR((up.energy_J - down.energy_J) / (2 * h), answer.gradient[i / 3][i % 3], 1e-9) << limit << " " << i;
      for (int j = 0; j < 12; ++j) EXPECT_EQ(answer.tangent[12 * i + j], answer.tangent[12 * j + i]);
    }
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j) {
        const double s = 1e-4;
        const auto both = [&](double a, double b) { return at(movedTwice(here, i, a, j, b), false).energy_J; };
        const double second = (both(s, s) - both(s, -s) - both(-s, s) + both(-s, -s)) / (4 * s * s);
        EXPECT_NEAR(second, answer.tangent[12 * i + j], 5e-6) << limit << " " << i << " " << j;
      }
  }
}

/// Seen from places beside the middles, in the places and turns of the sections themselves.
TEST(RodFriction, FromAsideAreDerivativesToo) {
  const Two before = crossed();
  const std::array<double, 2> aside{0.11, -0.07};
  const auto from = [&](const Two& p) { return Two{movedAside(p.first, aside[0]), movedAside(p.second, aside[1])}; };
  const RodGrip grip = gripBetween(from(before).first, from(before).second, {0.01, 0.02, 0.005});
  Two here = before;
  here.first.origin += Vec3{0.05, -0.03, -0.04};
  here.second.rotation = turned(here.second.rotation, {-0.2, 0.15, 0.25});
  for (const double limit : {10.0, 0.05}) {
    const auto energy = [&](const Two& p) {
      return evaluateRodFriction(grip, from(p).first, from(p).second, kStiffness, limit, false).energy_J;
    };
    const RodFrictionAnswer answer =
        fromAside(evaluateRodFriction(grip, from(here).first, from(here).second, kStiffness, limit, true), here.first,
                  here.second, aside, true);
    const double h = 1e-5, s = 1e-4;
    for (int i = 0; i < 12; ++i) {
      EXPECT_NEAR((energy(moved(here, i / 3, i % 3, h)) - energy(moved(here, i / 3, i % 3, -h))) / (2 * h),
                  answer.gradient[i / 3][i % 3], 1e-9)
          << limit << " " << i;
      for (int j = 0; j < 12; ++j) {
        const auto both = [&](double a, double b) { return energy(movedTwice(here, i, a, j, b)); };
        const double second = (both(s, s) - both(s, -s) - both(-s, s) + both(-s, -s)) / (4 * s * s);
        EXPECT_NEAR(second, answer.tangent[12 * i + j], 5e-6) << limit << " " << i << " " << j;
      }
    }
  }
}

/// A turn of both makes no slip; a turn of the one against the other by w makes w x c at the middle c between them.
TEST(RodFriction, SurfacesSlipWhereTheyMeet) {
  const Two before{{{}, {0.1, 0, 0.15}}, {{}, {0, 0.2, -0.15}}};
  const Vec3 slip{0.01, -0.004, 0};
  const RodGrip grip = gripBetween(before.first, before.second, slip);
  const Mat3 turn = rotationAbout(normalized({1, 2, -1}), 1.2);
  const auto carried = [&](const Pose& p) { return Pose{turn * p.rotation, turn * p.origin + Vec3{1, 2, 3}}; };
  const RodSlip there = slipOf(grip, carried(before.first), carried(before.second)),
                here = slipOf(grip, before.first, before.second);
  EXPECT_LT(norm(there.slip - turn * here.slip), 1e-14);

  const RodGrip fresh = gripBetween(before.first, before.second, {});
  const double w = 1e-6;
  const Mat3 spin = rotationAbout({0, 0, 1}, w);
  const Pose first{spin * before.first.rotation, spin * before.first.origin};
  const Vec3 middle = 0.5 * (before.first.origin + before.second.origin);
  Vec3 expected = w * cross({0, 0, 1}, middle);
  const Vec3 line = normalized(before.first.origin - before.second.origin);
  expected -= dot(expected, line) * line;
  EXPECT_LT(norm(slipOf(fresh, first, before.second).slip - expected), 1e-5 * w);
}

TEST(RodFriction, GivesWayAtTheLimit) {
  const double limit = 0.06;  // at a slip of 0.02
  EXPECT_DOUBLE_EQ(stickSlip(kStiffness, limit, 0.01).energy_J, 1.5e-4);
  EXPECT_DOUBLE_EQ(stickSlip(kStiffness, limit, 0.05).energy_J, 6e-4 + limit * 0.03);
  EXPECT_DOUBLE_EQ(0.05 * stickSlip(kStiffness, limit, 0.05).secant_N_per_m, limit);
}

TEST(RodFriction, RefusesWhatIsNoFriction) {
  const auto key = [](const RodFriction& f) -> std::string {
    try {
      checkRodFriction(f);
    } catch (const InputError& e) {
      return e.where().key;
    }
    return {};
  };
  EXPECT_EQ(key({0, 0}), "");
  EXPECT_EQ(key({0.3, 1e3}), "");
  EXPECT_EQ(key({-0.1, 1e3}), "friction.coefficient");
  EXPECT_EQ(key({10.1, 1e3}), "friction.coefficient");
  EXPECT_EQ(key({std::nan(""), 1e3}), "friction.coefficient");
  EXPECT_EQ(key({0.3, 0}), "friction.stick_stiffness");
  EXPECT_EQ(key({0.3, std::nan("")}), "friction.stick_stiffness");
}

}  // namespace
}  // namespace gambeson
