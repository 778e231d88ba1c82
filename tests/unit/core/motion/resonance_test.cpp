/// A step below the stable one may still gain energy: velocity Verlet's resonance of third order, at omega dt =
/// sqrt(3), with modes whose stiffness depends on their amplitude (core/motion/resonance.hpp has the sources).
/// Contact off, no gravity, no drag: nothing but the integration changes the energy.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/error.hpp"
#include "core/motion/resonance.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr int kCells = 12;
constexpr double kSide = 0.3;

Motion freeSheet() {
  ModelOptions o;
  o.self_contact = false;
  return Motion(squareSheet(kCells, kSide, 0), {{0, 0, 0}, 0}, {}, o);
}

/// Largest difference of a field over an edge of the control net, by the edge's length at rest.
double netStrain(const Model& m, const std::vector<Vec3>& field) {
  double most = 0;
  for (const NetEdge& e : m.net)
    most = std::max(most, norm(field[e.second] - field[e.first]) * std::sqrt(e.per_length2));
  return most;
}

TEST(Resonance, SwingIsTheAmplitudeOfTheHighestMode) {
  Motion m = freeSheet();
  const double omega = largestFrequency(*m.model, m.stage, m.state, 60, m.work).largest_rad_per_s;
  std::vector<Vec3> mode = m.state.mode;
  for (std::size_t i = 0; i < mode.size(); ++i) mode[i] *= 1 / std::sqrt(m.model->mass_kg[i]);
  const double amplitude = 1e-5, scale = amplitude / netStrain(*m.model, mode);
  for (std::size_t i = 0; i < mode.size(); ++i) m.state.p[i] += scale * mode[i];
  m.restart();
  double most = 0;
  const double dt = 0.4 * 2 / omega;
  for (int k = 0; k < 60; ++k) {
    const State before = m.state;
    ASSERT_EQ(m.step(dt).failure, StepFailure::none);
    most = std::max(most, swing(*m.model, before, m.state, dt, omega, m.work));
  }
  EXPECT_NEAR(most, amplitude, 0.03 * amplitude);  // phases of 47 degrees miss the peak by up to 3 % in 60 steps
}

/// A sheet that stretches slowly has strain and acceleration, but hardly any swing: a mode counts with the third power
/// of its frequency.
TEST(Resonance, SlowMotionIsNoSwing) {
  Motion m = freeSheet();
  const double omega = largestFrequency(*m.model, m.stage, m.state, 60, m.work).largest_rad_per_s;
  const double dt = 0.9 * 2 / omega;
  for (std::size_t i = 0; i < m.state.p.size(); ++i)
    m.state.v[i] = {0.1 * std::cos(M_PI / kSide * m.state.p[i].x), 0, 0};
  m.restart();
  double most = 0, strain = 0;
  const std::vector<Vec3> rest = m.state.p;
  for (int k = 0; k < 100; ++k) {
    const State before = m.state;
    ASSERT_EQ(m.step(dt).failure, StepFailure::none);
    most = std::max(most, swing(*m.model, before, m.state, dt, omega, m.work));
    std::vector<Vec3> moved = m.state.p;
    for (std::size_t i = 0; i < moved.size(); ++i) moved[i] -= rest[i];
    strain = std::max(strain, netStrain(*m.model, moved));
  }
  std::printf("[ measured ] swing %.3g at a strain of %.3g\n", most, strain);
  EXPECT_GT(strain, 2e-3);
  EXPECT_LT(most, 0.1 * strain);
}

TEST(Resonance, SharesKeepClearOfTheThirdOrder) {
  EXPECT_EQ(shareAtSwing(0.02, 0), 1);
  EXPECT_EQ(shareAtSwing(0.02, 1), 1);
  EXPECT_EQ(shareAtSwing(0.02, 0.8), 0.8);  // not yet
  EXPECT_EQ(shareAtSwing(0.014, 0.8), 1);
  EXPECT_EQ(shareAtSwing(0.1, 0.75), 0.75);
  EXPECT_EQ(shareAtSwing(0.07, 0.75), 0.8);
  for (double swing = 0.026; swing < 10; swing *= 1.1)
    for (double before : {0.0, 0.75, 1.0}) {
      EXPECT_LE(shareAtSwing(swing, before), 0.8);
      EXPECT_GE(shareAtSwing(swing, before), 0.7);
    }
}

/// The largest energy on the way, relative to the first; 100 where it ran away.
double growth(Motion& m, double duration_s) {
  m.restart();
  StepWork other;
  const double first = m.energy().total();
  double most = 0;
  int steps = 0;
  Frequency f;
  StepControl control;
  control.max_step_s = 1;
  try {
    VelocityVerlet(*m.model, m.stage, control, f, m.work)
        .advance(duration_s, m.state,
                 [&](const State&, const State& after, const StepReport&, const StepResult&, const Frequency&) {
                   if (++steps % 5) return;
                   most = std::max(most, energyOf(*m.model, m.stage, after, other).total() / first);
                   if (!(most < 100)) throw RunError("it ran away");
                 });
  } catch (const RunError&) {
    most = 100;
  }
  std::printf("[ measured ] energy at most times %.4f in %d steps\n", most, steps);
  return most;
}

/// Of a sheet that starts crumpled by noise of `part` of a cell.
double growthFromNoise(double part, unsigned seed, double duration_s) {
  Motion m = freeSheet();
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> d(-1, 1);
  for (Vec3& x : m.state.p) {
    const double a = d(random), b = d(random), c = d(random);
    x += (part * kSide / kCells) * Vec3{a, b, c};
  }
  return growth(m, duration_s);
}

/// At 0.9 of the stable step throughout, the energy of each of these is multiplied by 1.7 to 105; at these shares but
/// with steps that follow an estimate of the frequency in every step, that of the first one by 53. What remains is that
/// the energy of the discrete motion is a little off that of the continuous one.
TEST(Resonance, CrumpledSheetsKeepTheirEnergyAtNineTenthsOfTheStableStep) {
  EXPECT_LT(growthFromNoise(0.005, 1, 2), 1.1);
  for (double part : {0.02, 0.03, 0.05, 0.08})
    for (unsigned seed : {1u, 2u}) EXPECT_LT(growthFromNoise(part, seed, 0.5), 1.1);
}

/// Stretched and then crushed by its own inertia, with halves that part at up to 40 m/s where waves travel at 16 m/s:
/// the largest frequency trebles, and with estimates every 50 steps the motion is not finite after 50 ms.
TEST(Resonance, SuddenlyStretchedAndCrushedSheetsKeepTheirEnergy) {
  for (double speed : {8.0, 16.0, 20.0}) {
    Motion m = freeSheet();
    for (std::size_t i = 0; i < m.state.p.size(); ++i) {
      Vec3& x = m.state.p[i];
      m.state.v[i] = {-speed * std::cos(M_PI / kSide * x.x), 0, 0};
      x += 1e-4 * Vec3{std::sin(1e5 * x.x), std::sin(2e5 * x.y), std::sin(1e5 * (x.x + 3 * x.y))};
    }
    EXPECT_LT(growth(m, 0.1), 1.05) << speed;
  }
}

}  // namespace
}  // namespace gambeson
