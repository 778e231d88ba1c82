/// Velocity Verlet on oscillators with closed forms.

#include "core/motion/velocity_verlet.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "unit/core/motion/empty_stage.hpp"
#include "unit/core/motion/spring_points.hpp"

namespace gambeson {
namespace {

using namespace shapes;
using Vector = SpringPoints::Vector;

/// Oscillators that start at x with the velocities v. `damping` [1/s].
struct Oscillators {
  std::unique_ptr<Model> model;
  EmptyStage stage;
  StepWork work;
  Frequency frequency;
  State state;

  Oscillators(SpringPoints::Law law, const std::vector<double>& x, const std::vector<double>& v = {},
              double damping = 0) {
    ModelOptions o;
    o.self_contact = false;
    model = buildModel(std::make_unique<SpringPoints>(static_cast<int>(x.size()), std::move(law)), o, {Vec3{}, damping},
                       {}, {});
    state = initialState(*model, stage, 0, work);
    for (std::size_t i = 0; i < x.size(); ++i) state.p[i].x = x[i];
    for (std::size_t i = 0; i < v.size(); ++i) state.v[i].x = v[i];
    attachSprings(*model, stage, state, work);
  }

  void run(double end, const StepControl& control, const std::function<void(const State&)>& watch = {}) {
    VelocityVerlet(*model, stage, control, frequency, work)
        .advance(end, state,
                 [&](const State&, const State& now, const StepReport&, const StepResult&, const Frequency&) {
                   if (watch) watch(now);
                 });
    EXPECT_EQ(state.time_s, end);
  }
};

StepControl fixedSteps(double dt) {
  StepControl control;
  control.fixed_s = dt;
  return control;
}
StepControl stableSteps(double safety) {
  StepControl control;
  control.safety = safety;
  control.max_step_s = 1e9;
  return control;
}

SpringPoints::Law spring(double omega) {
  return [omega](const Vector& x) -> Vector { return omega * omega * x; };
}
/// x'' + x + x^3 = 0.
Vector duffing(const Vector& x) { return x.array() + x.array().cube(); }
/// Its period from rest at A: 4 K(k)/sqrt(1 + A^2), k^2 = A^2/(2 (1 + A^2)).
double duffingPeriod(double A) {
  return 4 * std::comp_ellint_1(std::sqrt(A * A / (2 * (1 + A * A)))) / std::sqrt(1 + A * A);
}
double duffingEnergy(double x, double v) { return 0.5 * v * v + 0.5 * x * x + 0.25 * std::pow(x, 4); }

/// The velocity after one period, where it should be zero again.
TEST(VelocityVerlet, IsOfSecondOrder) {
  const double period = duffingPeriod(1.5);
  double error[3];
  for (int k = 0; k < 3; ++k) {
    Oscillators o(duffing, {1.5});
    o.run(period, fixedSteps(period / (200 << k)));
    error[k] = std::abs(o.state.v[0].x);
  }
  EXPECT_LT(error[2], 1e-3);
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.05);
  EXPECT_NEAR(std::log2(error[1] / error[2]), 2, 0.05);
}

/// x_n = cos(n theta), sin(theta/2) = omega h/2: what the scheme itself gives.
TEST(VelocityVerlet, IsTheDiscreteOscillator) {
  Oscillators o(spring(2), {1});
  const double theta = 2 * std::asin(0.35);
  int n = 0;
  o.run(35, fixedSteps(0.35), [&](const State& s) { EXPECT_NEAR(s.p[0].x, std::cos(++n * theta), 1e-11); });
  EXPECT_EQ(n, 100);
}

/// 10,000 steps at a quarter of the critical one: the mean energy of the last tenth against the first tenth, and the
/// fluctuation falls with the square of the step.
TEST(VelocityVerlet, KeepsTheEnergyInTheMean) {
  const double critical = 2 / std::sqrt(1 + 3 * 1.5 * 1.5), energy0 = duffingEnergy(1.5, 0);
  double deviation[2];
  for (int k : {0, 1}) {
    const int steps = 10000 << k;
    const double dt = critical / (4 << k);
    double first = 0, last = 0, kinetic = 0, most = 0;
    int n = 0;
    Oscillators o(duffing, {1.5});
    o.run(steps * dt, fixedSteps(dt), [&](const State& s) {
      const double energy = duffingEnergy(s.p[0].x, s.v[0].x);
      if (n < steps / 10) first += energy / (steps / 10);
      if (n >= steps - steps / 10) last += energy / (steps / 10);
      most = std::max(most, std::abs(energy - energy0));
      kinetic = std::max(kinetic, 0.5 * norm2(s.v[0]));
      ++n;
    });
    EXPECT_LT(std::abs(last - first), 1e-3 * kinetic);
    deviation[k] = most;
  }
  EXPECT_GT(deviation[0] / deviation[1], 3.5);
}

/// x'' + d x' + omega^2 x = 0.
TEST(VelocityVerlet, DampingAgreesWithTheClosedForm) {
  const double omega = 2, end = 4, d = 0.3, w = std::sqrt(omega * omega - d * d / 4);
  Oscillators o(spring(omega), {1}, {}, d);
  o.run(end, fixedSteps(1e-3));
  EXPECT_NEAR(o.state.p[0].x, std::exp(-d * end / 2) * (std::cos(w * end) + d / (2 * w) * std::sin(w * end)), 1e-5);
}

/// A chain of 50 masses held at both ends: omega_max = 2 sqrt(k/m) sin(50 pi/(2 51)).
TEST(VelocityVerlet, TheStableStepIsThatOfTheHighestMode) {
  const int n = 50;
  const SpringPoints::Law chain = [](const Vector& x) {
    Vector f = 2 * x;
    f.head(n - 1) -= x.tail(n - 1);
    f.tail(n - 1) -= x.head(n - 1);
    return f;
  };
  std::vector<double> start(n, 0.0);
  start[7] = 1e-3;
  const double omega = 2 * std::sin(n * M_PI / (2.0 * (n + 1)));
  Oscillators o(chain, start);
  double first = 0;
  o.run(200, stableSteps(1), [&](const State& s) { first = first > 0 ? first : s.time_s; });
  EXPECT_NEAR(o.frequency.largest_rad_per_s, omega, 0.01 * omega);
  EXPECT_NEAR(first, 0.8 * 2 / omega, 0.02 * 2 / omega);  // of the first step, when no swing is known
  // At 1.1 of the stable step the motion grows without bound.
  Oscillators fast(chain, start);
  double most = 0;
  fast.run(200, fixedSteps(1.1 * 2 / omega), [&](const State& s) { most = std::max(most, std::abs(s.p[7].x)); });
  EXPECT_GT(most, 1e3);
}

/// A mass on the spring f = x + 1e4 x^3, thrown from x = 0 with v = 1: slope 1 there, 425 where it turns, so that the
/// step of the start is 20 times the stable one of the turn. Its energy 1/2 is kept; steps of the start's length lose
/// it by orders. A free chain beside it keeps the mass a small part of all that moves.
TEST(VelocityVerlet, TheStepFollowsAStiffnessThatRises) {
  const SpringPoints::Law law = [](const Vector& x) {
    Vector f = x;
    f(0) += 1e4 * x(0) * x(0) * x(0);
    return f;
  };
  Oscillators o(law, {0, 0, 0, 1, 0, 0}, {1});
  std::vector<double> energies;
  o.run(20, stableSteps(0.5), [&](const State& s) {
    const double x = s.p[0].x;
    energies.push_back(0.5 * norm2(s.v[0]) + 0.5 * x * x + 2500 * x * x * x * x);
  });
  for (const double e : energies) EXPECT_NEAR(e, 0.5, 0.1);
}

/// The same on f = x + 1e9 x^3, whose turn is 366 times as stiff as its rest: no length of the step is of use there.
TEST(VelocityVerlet, SaysThatTheClothIsCrushed) {
  Oscillators o(
      [](const Vector& x) {
        Vector f = x;
        f(0) += 1e9 * x(0) * x(0) * x(0);
        return f;
      },
      {0, 0, 0, 1, 0, 0}, {1});
  try {
    o.run(20, stableSteps(0.5));
    FAIL();
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("crushed or torn"), std::string::npos) << e.what();
  }
  EXPECT_LT(std::abs(o.state.p[0].x), 7e-3);  // (2 / 1e9)^(1/4), where it turns
}

/// A force that ends at x = 0.3: the message says why, and the last accepted state is left.
TEST(VelocityVerlet, SaysThatAMotionIsNotFinite) {
  Oscillators o([](const Vector& x) -> Vector { return x.unaryExpr([](double v) { return v < 0.3 ? v : NAN; }); }, {0},
                {5});
  try {
    o.run(1, fixedSteps(1e-3));
    FAIL();
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("not finite"), std::string::npos) << e.what();
  }
  EXPECT_TRUE(std::isfinite(o.state.v[0].x));
  EXPECT_GT(o.state.p[0].x, 0.29);
}

}  // namespace
}  // namespace gambeson
