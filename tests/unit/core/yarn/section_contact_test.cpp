#include "core/yarn/section_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/math/quadrature.hpp"
#include "core/yarn/rod.hpp"

namespace gambeson {
namespace {

constexpr LateralCompression kLaw{5, 3};

CrossingContact crossing() { return {kLaw, {0.24, 0.3}, {0.16, 0.12}}; }
BesideContact beside() { return {kLaw, 0.24, 0.16, 0.28, pressureShare(crossing())}; }

/// Sections of a weft (across it: axis 2) and of a warp (across it: -axis 1) that lies below.
Pose weftAt(const Vec3& x) { return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, x}; }
Pose warpAt(const Vec3& x) { return {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}, x}; }

struct Two {
  Pose first, second;
};
/// Moved by unknowns (x1, turn1, x2, turn2), turns as one exponential.
Two moved(const Two& at, const std::array<double, 12>& by) {
  const auto vec = [&](int b) { return Vec3{by[3 * b], by[3 * b + 1], by[3 * b + 2]}; };
  return {{turned(at.first.rotation, vec(1)), at.first.origin + vec(0)},
          {turned(at.second.rotation, vec(3)), at.second.origin + vec(2)}};
}

template <class Evaluate>
void expectDerivatives(const Two& here, const Evaluate& evaluate) {
  const SectionPair answer = evaluate(here, true);
  ASSERT_GT(answer.energy, 0);
  const auto energy = [&](std::array<double, 12> by) { return evaluate(moved(here, by), false).energy; };
  double steepest = 0, stiffest = 0;
  for (int i = 0; i < 12; ++i) steepest = std::max(steepest, std::abs(answer.gradient[i / 3][i % 3]));
  for (const double t : answer.tangent) stiffest = std::max(stiffest, std::abs(t));
  const double h = 1e-5, s = 1e-4;
  for (int i = 0; i < 12; ++i) {
    std::array<double, 12> up{}, down{};
    up[i] = h, down[i] = -h;
    EXPECT_NEAR((energy(up) - energy(down)) / (2 * h), answer.gradient[i / 3][i % 3], 1e-7 * steepest) << i;
    for (int j = 0; j < 12; ++j) {
      const auto both = [&](double a, double b) {
        std::array<double, 12> by{};
        by[i] += a, by[j] += b;
        return energy(by);
      };
      const double second = (both(s, s) - both(s, -s) - both(-s, s) + both(-s, -s)) / (4 * s * s);
      EXPECT_NEAR(second, answer.tangent[12 * i + j], 1e-5 * stiffest) << i << " " << j;
      EXPECT_NEAR(answer.tangent[12 * i + j], answer.tangent[12 * j + i], 1e-13 * stiffest);
    }
  }
}

const Mat3 kLeans = turned({}, {0.15, -0.1, 0.4}), kTilts = turned({}, {-0.1, 0.2, -0.1});

TEST(SectionContact, ForcesAndTangentOfACrossingAreDerivatives) {
  for (const double above : {1.0, -1.0}) {
    const Two here{{kLeans, {0.03, 0.05, above * 0.1}}, {warpAt({}).rotation * kTilts, {-0.02, 0.04, -above * 0.08}}};
    expectDerivatives(
        here, [&](const Two& p, bool tangent) { return crossing().evaluate(p.first, p.second, above, tangent); });
  }
}

TEST(SectionContact, ForcesAndTangentOfNeighboursAreDerivatives) {
  const Two here{{kLeans, {0.01, 0.25, 0.1}}, {kTilts, {-0.02, -0.01, 0.02}}};
  expectDerivatives(here, [](const Two& p, bool tangent) { return beside().evaluate(p.first, p.second, tangent); });
}

/// Neither sees where the two are, nor how they are turned together.
TEST(SectionContact, WhatMovesBothIsFree) {
  const Pose g{turned({}, {0.5, -1, 0.3}), {3, 1, 2}};
  const Two here{{kLeans, {0.03, 0.05, 0.1}}, {warpAt({}).rotation * kTilts, {-0.02, 0.04, -0.08}}};
  EXPECT_NEAR(crossing().evaluate(g * here.first, g * here.second, 1, false).energy,
              crossing().evaluate(here.first, here.second, 1, false).energy, 1e-12);
  const Two side{{kLeans, {0.03, 0.35, 0.1}}, {kTilts, {-0.02, -0.01, -0.03}}};
  EXPECT_NEAR(beside().evaluate(g * side.first, g * side.second, false).energy,
              beside().evaluate(side.first, side.second, false).energy, 1e-12);
}

/// Sums over sections of two straight yarns, `h` apart, at an angle; the first turned about itself.
struct Straight {
  double energy = 0, pressing = 0, torque = 0;
};
Straight straight(double h, double angle, double turn) {
  const CrossingContact contact = crossing();
  const int n = 200;
  const double step = 2.0 / n;
  const Mat3 second = rotationAbout({0, 0, 1}, angle - std::numbers::pi / 2) * warpAt({}).rotation;
  const Mat3 first = rotationAbout({1, 0, 0}, turn);
  Straight sum;
  for (int i = -n / 2; i <= n / 2; ++i)
    for (int j = -n / 2; j <= n / 2; ++j) {
      const SectionPair pair = contact.evaluate({first, {i * step, 0, h}}, {second, (j * step) * second.a}, 1, false);
      sum.energy += step * step * pair.energy;
      sum.pressing += step * step * pair.gradient[0].z;
      sum.torque += step * step * pair.gradient[1].x;
    }
  return sum;
}

/// Two elliptical cylinders at rest on each other: the law of lateral compression, by the sine of the angle.
TEST(SectionContact, CrossedCylindersCarryTheLaw) {
  const double touch = crossing().touch_m();
  for (const double h : {0.9 * touch, 0.7 * touch})
    for (const double angle : {90.0, 60.0}) {
      const double rad = angle * std::numbers::pi / 180, force = kLaw.force_N(h, touch) / std::sin(rad);
      EXPECT_NEAR(straight(h, rad, 0).pressing, -force, 2e-4 * force) << h << " " << angle;
    }
  EXPECT_EQ(straight(1.0001 * touch, 1.2, 0).energy, 0) << "without a force where they touch";
}

/// A turn over the other's width is turned back: of a bed of springs under the parabolas, d(torque)/d(turn) = integral
/// of psi'' v² dA less what pressure takes, here against differences of the energy; and it is not small.
TEST(SectionContact, TurnsOverTheWidthAreTurnedBack) {
  const double h = 0.7 * crossing().touch_m(), turn = 0.02;
  const Straight there = straight(h, std::numbers::pi / 2, turn);
  EXPECT_NEAR(straight(h, std::numbers::pi / 2, 0).torque, 0, 1e-12);
  const double step = 1e-4;
  const double slope =
      (straight(h, std::numbers::pi / 2, turn + step).energy - straight(h, std::numbers::pi / 2, turn - step).energy) /
      (2 * step);
  EXPECT_NEAR(there.torque, slope, 1e-5 * slope);
  EXPECT_GT(there.torque, 0.3 * kLaw.force_N(h, crossing().touch_m()) * crossing().half_width_m[0] * turn);
}

/// Two straight yarns side by side: nothing until they are as near as they are wide, then the energy by length of a bed
/// of springs between two parabolas (the docstring's integral), and none above each other before they touch there.
TEST(SectionContact, NeighboursJamByTheirWidth) {
  const BesideContact contact = beside();
  const double D = contact.touch_m, a = contact.half_width_m, b = contact.half_thickness_m;
  const auto byLength = [&](double y, double z) {
    const int n = 2000;
    double sum = 0;
    for (int i = -n; i <= n; ++i)
      sum += 0.5 / n * contact.evaluate(weftAt({0.5 * i / n, y, z}), weftAt({}), false).energy;
    return sum;
  };
  EXPECT_EQ(byLength(2.0001 * a, 0), 0);
  EXPECT_EQ(byLength(0, 2.0001 * b), 0);
  EXPECT_GT(byLength(1.99 * a, 0), 0);
  EXPECT_GT(byLength(0.6 * 2 * a, 0.79 * 2 * b), 0) << "0.6² + 0.79² < 1";
  EXPECT_EQ(byLength(0.6 * 2 * a, 0.81 * 2 * b), 0);
  for (const double part : {0.99, 0.95}) {
    const double reach = b * std::sqrt(2 * (1 - part));
    const Quadrature rule = gaussLegendre(20);
    double bed = 0;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      const double z = reach * (2 * rule.points[q] - 1), d = D * (part + z * z / (2 * b * b));
      bed += rule.weights[q] * 2 * reach * 2 * a / D * contact.by_area * kLaw.force_N(d, D);
    }
    EXPECT_NEAR(byLength(part * 2 * a, 0), bed, (1 - part) * bed) << part;
  }
}

}  // namespace
}  // namespace gambeson
