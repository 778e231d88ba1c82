// Friction that depends on the motion, on one sample: a card on a slope, a block on a spring (Wong 2014, chapter 7).
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/contact/response.hpp"

namespace gambeson {
namespace {

constexpr double kGravity = 9.81, kMass_kg = 1, kArea_m2 = 1;

FrictionLaw law(double kinetic, double still, double speed = 0, double power = 1, double viscosity = 0) {
  FrictionLaw f;
  f.kinetic = kinetic;
  f.still = still;
  f.stribeck_m_per_s = speed;
  f.stribeck_power = power;
  f.viscosity = viscosity;
  return f;
}

/// A sample of 1 kg on a plane along x that may be tilted; its normal is z.
struct Block {
  ContactParameters parameters;
  double dt = 1e-3, slope = 0;  ///< tangent
  Vec3 x, v;
  std::vector<Vec3> warm{1}, impulses;
  std::vector<RowSlip> slip{1};
  ContactWork work;
  SparseRows W{1, {0, 1}, {0}, {1.0}};
  ContactSolve solve;

  explicit Block(const FrictionLaw& friction) {
    parameters.friction = friction;
    parameters.relaxation_s = 0.01;
    parameters.tolerance_m_per_s2 = 1e-6;
  }
  Vec3 weight() const {
    const double angle = std::atan(slope);
    return {kGravity * std::sin(angle), 0, -kGravity * std::cos(angle)};
  }
  /// One step under its weight and `force` [N] along x, on ground that moves at `ground`.
  void step(double force, double ground = 0) {
    Contact c;
    c.normal = {0, 0, 1};
    const ContactRow row = bodyRow(c, {ground, 0, 0}, 0, false);
    const std::vector<double> inverse{1 / kMass_kg}, area{kArea_m2}, density{kMass_kg / kArea_m2};
    std::vector<Vec3> velocity{v + dt * (weight() + Vec3{force / kMass_kg, 0, 0})};
    slip[0].broke = false;
    solve = solveContacts({&row, 1}, W, inverse, area, density, {}, parameters, dt, velocity, warm, impulses, work,
                          nullptr, slip);
    EXPECT_TRUE(solve.converged);
    v = velocity[0];
    slip[0].slips = slip[0].slips && slip[0].speed_m_per_s > parameters.still(dt);
    x += dt * v;
  }
};

/// Speed and way of a card after 1 s on a slope of tan = 0.3.
std::pair<double, double> card(const FrictionLaw& friction, double dt = 1e-3) {
  Block block(friction);
  block.slope = 0.3;
  block.dt = dt;
  double way = 0;
  for (int i = 0; i < static_cast<int>(std::round(1 / dt)); ++i) {
    const double before = block.v.x;
    block.step(0);
    way += 0.5 * dt * (before + block.v.x);
  }
  return {block.v.x, way};
}

TEST(Slip, CardsOfTheFourModels) {
  const auto expectCard = [](const FrictionLaw& f, double speed, double way) {
    const auto [v, x] = card(f);
    EXPECT_NEAR(v / speed, 1, 2e-3);
    EXPECT_NEAR(x / way, 1, 2e-3);
  };
  expectCard(law(0.1, 0.1), 1.879, 0.940);            // C
  expectCard(law(0.1, 0.2), 1.879, 0.940);            // CS
  expectCard(law(0.1, 0.2, 0.4, 0.2), 1.555, 0.760);  // CSS
  expectCard(law(0.1, 0.2, 0.4, 1), 1.606, 0.732);
  expectCard(law(0.1, 0.2, 0.4, 0.2, 0.3), 1.344, 0.689);  // CSSV
  expectCard(law(0.1, 0.2, 0.4, 1, 0.3), 1.392, 0.662);
}

/// With mu_s = 2 mu_c, a card with mu_c = 0.2 moves in model C alone, one with more than 0.3 in none.
TEST(Slip, WhatSticksIsHeldByTheStaticCoefficient) {
  EXPECT_GT(card(law(0.2, 0.2)).first, 0.5);
  for (const FrictionLaw& f :
       {law(0.2, 0.4), law(0.2, 0.4, 0.4, 0.2), law(0.2, 0.4, 0.4, 1, 0.3), law(0.31, 0.31), law(0.31, 0.62)})
    EXPECT_LT(card(f).second, 1e-9);
  EXPECT_GT(card(law(0.14, 0.28)).first, 0.5) << "tan = 0.3 is more than it holds";
  Block block(law(0.1, 0.4));
  block.slope = 0.3;
  for (int i = 0; i < 60000; ++i) block.step(0);
  EXPECT_LT(std::abs(block.x.x), 1e-9) << "it creeps";
}

struct StickSlip {
  double period_s, most, least;  ///< of the spring's force, in weights
};
/// A block of 1 kg drawn by a spring of 400 N/m whose end moves at 50 mm/s.
StickSlip stickSlip(const FrictionLaw& friction, double end_s, double dt = 1e-3) {
  constexpr double k = 400, v0 = 0.05, N = kMass_kg * kGravity;
  Block block(friction);
  block.dt = dt;
  StickSlip out{0, -10, 10};
  double first = 0, last = 0;
  int starts = 0;
  bool stuck = true;
  for (int i = 0; i < static_cast<int>(end_s / dt); ++i) {
    // As velocity Verlet does: forces at the ends of steps, velocities between them.
    const double t = i * dt;
    block.step(k * (v0 * t - block.x.x));
    const double force = k * (v0 * (i + 1) * dt - block.x.x) / N;
    const bool sticks = !block.slip[0].slips;
    if (stuck && !sticks && t > 0.3 * end_s) {
      if (starts++ == 0) first = t;
      last = t;
    }
    stuck = sticks;
    if (starts > 0) out.most = std::max(out.most, force), out.least = std::min(out.least, force);
  }
  out.period_s = starts > 1 ? (last - first) / (starts - 1) : 0;
  return out;
}

TEST(Slip, ABlockOnASpringSticksAndSlips) {
  constexpr double N = kMass_kg * kGravity, w = 20, v0 = 0.05, y0 = 0.3 * N / 400;
  const StickSlip cs = stickSlip(law(0.1, 0.4), 20);
  EXPECT_NEAR(cs.period_s / (2 * y0 / v0 + 2 / w * (M_PI - std::atan(w * y0 / v0))), 1, 5e-3);
  const double amplitude = 400 * std::sqrt(y0 * y0 + v0 * v0 / (w * w)) / N;
  EXPECT_NEAR(cs.most, 0.1 + amplitude, 5e-3 * 0.417);
  EXPECT_NEAR(cs.least, 0.1 - amplitude, 5e-3 * 0.417);
  const StickSlip one = stickSlip(law(0.1, 0.4, 0.4, 1), 20), two = stickSlip(law(0.1, 0.4, 0.4, 2), 20);
  EXPECT_NEAR(one.period_s / 0.3610, 1, 5e-3);
  EXPECT_NEAR(one.most / 0.495, 1, 5e-3);
  EXPECT_NEAR(one.least / 0.156, 1, 5e-3);
  EXPECT_NEAR(two.period_s / 0.3219, 1, 5e-3);
  EXPECT_NEAR(two.most / 0.501, 1, 5e-3);
  EXPECT_NEAR(two.least / 0.265, 1, 5e-3);
  EXPECT_EQ(stickSlip(law(0.1, 0.1), 20).period_s, 0) << "Coulomb's friction lets it slide";
}

/// Steady sliding over ground whose friction falls with the speed is stable only with as much damping as it falls.
TEST(Slip, SteadySlidingNeedsDamping) {
  constexpr double k = 400, v0 = 0.05, N = kMass_kg * kGravity, vS = 0.4;
  const FrictionLaw f = law(0.1, 0.4, vS, 1);
  const double critical = N * 0.3 / vS * std::exp(-v0 / vS);
  for (const double part : {0.9, 1.1}) {
    Block block(f);
    block.dt = 2.5e-4;
    block.v = {1.02 * v0, 0, 0};
    const double c = part * critical;
    block.x = {-(f.slipping(v0) * N + c * v0) / k, 0, 0};
    block.slip[0] = {true, false, v0, 0, 0, {}};
    const int steps = static_cast<int>(20 / block.dt);
    double early = 0, late = 0;
    for (int i = 0; i < steps; ++i) {
      block.step(k * (v0 * i * block.dt - block.x.x) - c * block.v.x);
      double& largest = i < steps / 4 ? early : late;
      if (i < steps / 4 || i > 3 * steps / 4) largest = std::max(largest, std::abs(block.v.x - v0));
    }
    if (part > 1)
      EXPECT_LT(late, 0.5 * early);
    else
      EXPECT_GT(late, 2 * early);
  }
}

TEST(Slip, FrictionGoesWithThePressure) {
  FrictionLaw f = law(0.2, 0.2);
  f.pressure_Pa = 1;
  f.pressure_power = 0.8;
  EXPECT_FALSE(f.isCoulomb());
  Block block(f);
  block.v = {2, 0, 0};
  for (int i = 0; i < 200; ++i) block.step(0);
  const double mu = 0.2 * std::pow(kGravity, -0.2);
  EXPECT_NEAR(block.v.x, 2 - mu * kGravity * 0.2, 1e-3);
}

/// Along the weft mu, along the warp w mu, between them an ellipse; friction is opposite to the slip.
TEST(Slip, FrictionGoesWithTheDirectionOfTheCloth) {
  FrictionLaw f = law(0.2, 0.2);
  f.along_warp = 1.6;
  EXPECT_FALSE(f.isCoulomb());
  for (const double degrees : {0.0, 30.0, 90.0, 120.0}) {
    const double angle = degrees * M_PI / 180;
    Block block(f);
    block.v = {2 * std::cos(angle), 2 * std::sin(angle), 0};
    block.slip[0] = {true, false, 2, 0, 0, {1, 0, 0}};
    for (int i = 0; i < 200; ++i) block.step(0);
    const double mu = 0.2 * std::sqrt(std::pow(std::cos(angle), 2) + std::pow(1.6 * std::sin(angle), 2));
    EXPECT_NEAR(norm(block.v), 2 - mu * kGravity * 0.2, 1e-3) << degrees;
    EXPECT_NEAR(block.v.x * std::sin(angle) - block.v.y * std::cos(angle), 0, 1e-9) << degrees;
  }
  // What sticks is held by that of the direction in which it is drawn.
  Block block(f);
  block.slip[0].weft = {0, 1, 0};
  block.slope = 0.3;
  for (int i = 0; i < 100; ++i) block.step(0);
  EXPECT_LT(std::abs(block.x.x), 1e-9) << "0.32 along the warp";
  Block weft(f);
  weft.slip[0].weft = {1, 0, 0};
  weft.slope = 0.3;
  for (int i = 0; i < 100; ++i) weft.step(0);
  EXPECT_GT(weft.x.x, 1e-4) << "0.2 along the weft";
}

TEST(Slip, ACoulombLawNeedsNoState) {
  Block block(law(0.3, 0.3));
  block.slip.clear();
  block.slip.resize(1);
  EXPECT_TRUE(block.parameters.friction.isCoulomb());
  EXPECT_FALSE(block.parameters.followsMotion());
  block.parameters.on_cloth = law(0.1, 0.2);
  EXPECT_TRUE(block.parameters.followsMotion());
  block.parameters.of_obstacle = {std::nullopt, FrictionLaw(0.7)};
  ContactRow row = bodyRow({}, {}, 0, false);
  EXPECT_EQ(block.parameters.frictionOf(row).kinetic, 0.3);
  row.contact.obstacle = 1;
  EXPECT_EQ(block.parameters.frictionOf(row).kinetic, 0.7);
  block.parameters.of_garment = {std::nullopt, FrictionLaw(0.6)};
  block.parameters.garment_of_sample = {1};
  EXPECT_EQ(block.parameters.frictionOf(row).kinetic, 0.7) << "an obstacle's is before a garment's";
  row.contact.obstacle = 0;
  EXPECT_EQ(block.parameters.frictionOf(row).kinetic, 0.6);
  row.contact.obstacle = -1;
  EXPECT_EQ(block.parameters.frictionOf(row).still, 0.2);
}

}  // namespace
}  // namespace gambeson
