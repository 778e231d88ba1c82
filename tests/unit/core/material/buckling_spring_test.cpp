/// Choi and Ko's strip: its start, its circle, and force and slope as derivatives of the energy.

#include "core/material/laws/buckling_spring.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gambeson {
namespace {

constexpr double kb = 2e-8, L = 0.02;

TEST(BucklingSpring, InvertsSinc) {
  for (const double a : {1e-6, 1e-3, 0.01, 0.02, 0.0245, 0.1, 1.0, 2.0, 3.0, 3.14, std::numbers::pi}) {
    const double x = std::sin(a) / a;
    // Where 1 - x is all that is left of x, rounding moves a by eps/a.
    EXPECT_NEAR(inverseSinc(x), a, 1e-13 + 1e-15 / a) << a;
  }
  EXPECT_EQ(inverseSinc(1), 0);
  EXPECT_NEAR(inverseSinc(0), std::numbers::pi, 1e-14);
}

TEST(BucklingSpring, StartsWithTwelveTimesTheRigidityOverTheLengthSquared) {
  EXPECT_NEAR(bucklingForce(kb, L, 1e-4), -12 * kb / (L * L), 1e-5 * 12 * kb / (L * L));
  EXPECT_NEAR(bucklingForce(kb, L, 0), -12 * kb / (L * L), 1e-15 * 12 * kb / (L * L));
  // Bent to a circle: kappa = 2 pi/L, cos pi - sinc pi = -1.
  const double kappa = 2 * std::numbers::pi / L;
  EXPECT_NEAR(bucklingForce(kb, L, std::numbers::pi), -kb * kappa * kappa, 1e-12 * kb * kappa * kappa);
}

TEST(BucklingSpring, ForceAndSlopeAreDerivativesOfTheEnergy) {
  for (const double start : {5.0, 100.0, 1e4}) {
    const BucklingSpring s(kb, L, start);
    const double step = 1e-9;
    for (const double d : {0.3 * L, 0.7 * L, 0.95 * L, 0.999 * L, 0.99999 * L, 1.01 * L}) {
      if (std::abs(L - d - s.shortest_m()) < 2 * step) continue;
      const auto at = [&](double x) { return s.answer(x * x); };
      const SpringAnswer<double> now = at(d), before = at(d - step), after = at(d + step);
      const double force = (after.energy - before.energy) / (2 * step), scale = 12 * kb / (L * L);
      EXPECT_NEAR(now.per_length * d, force, 1e-5 * scale) << start << " " << d / L;
      const double slope = (after.per_length * (d + step) - before.per_length * (d - step)) / (2 * step);
      EXPECT_NEAR(now.along, slope, 1e-5 * std::max(start, scale / L)) << start << " " << d / L;
    }
  }
}

TEST(BucklingSpring, BeginsAsAHookeSpringAndPullsNothing) {
  const BucklingSpring s(kb, L, 100);
  EXPECT_EQ(s.answer(1.1 * L * L).per_length, 0);
  EXPECT_EQ(s.answer(1.1 * L * L).energy, 0);
  EXPECT_GT(s.shortest_m(), 12 * kb / (L * L * 100));
  EXPECT_LT(s.shortest_m(), 12.1 * kb / (L * L * 100));
  const double d = L - 0.5 * s.shortest_m();
  EXPECT_NEAR(s.answer(d * d).per_length * d, -100 * 0.5 * s.shortest_m(), 1e-15);
  // Energy and force go on where the strip takes over.
  const double low = L - s.shortest_m() * (1 + 1e-9), high = L - s.shortest_m() * (1 - 1e-9);
  EXPECT_NEAR(s.answer(low * low).energy, s.answer(high * high).energy, 1e-8 * s.answer(low * low).energy);
  EXPECT_NEAR(s.answer(low * low).per_length, s.answer(high * high).per_length, 1e-7 * -s.answer(low * low).per_length);
  // Too soft a start never meets the strip.
  const BucklingSpring soft(kb, L, 4 * kb / (L * L * L));
  EXPECT_EQ(soft.shortest_m(), L);
}

}  // namespace
}  // namespace gambeson
