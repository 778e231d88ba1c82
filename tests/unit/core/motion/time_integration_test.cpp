/// Newmark, generalised-alpha and explicit steps on oscillators with closed forms.

#include "core/motion/time_integration.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "unit/core/statics/small_systems.hpp"

namespace gambeson {
namespace {

using namespace shapes;

SmallSystem oscillator(double omega) {
  return linearSystem(Eigen::MatrixXd::Constant(1, 1, omega * omega), Eigen::VectorXd::Zero(1));
}

/// y'' + y + y^3 = 0.
SmallSystem duffing() {
  SmallSystem s(1);
  s.force = [](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, y(0) + std::pow(y(0), 3)); };
  s.tangent = [](const Eigen::VectorXd& y) { return Eigen::MatrixXd::Constant(1, 1, 1 + 3 * y(0) * y(0)); };
  return s;
}
/// Its period from rest at A: 4 K(k)/sqrt(1 + A^2), k^2 = A^2/(2 (1 + A^2)).
double duffingPeriod(double A) {
  return 4 * std::comp_ellint_1(std::sqrt(A * A / (2 * (1 + A * A)))) / std::sqrt(1 + A * A);
}
double duffingEnergy(const DynamicState& s) {
  return 0.5 * s.v[0] * s.v[0] + 0.5 * s.y[0] * s.y[0] + 0.25 * std::pow(s.y[0], 4);
}

DynamicState run(
    System& system, const DynamicOptions& options, DynamicState state,
    const DynamicObserver& observe = [](const DynamicState&) { return true; }) {
  const DynamicReport r = integrate(system, options, state, observe);
  EXPECT_TRUE(r.reached) << r.why;
  EXPECT_EQ(state.time_s, options.end_s);
  return state;
}

/// Order of the velocity after one period, where it should be zero again.
double order(DynamicOptions o, double expected_error) {
  SmallSystem s = duffing();
  o.end_s = duffingPeriod(1.5);
  double error[3];
  for (int k = 0; k < 3; ++k) {
    o.step_s = o.end_s / (200 << k);
    error[k] = std::abs(run(s, o, {0, {1.5}, {0}, {}}).v[0]);
  }
  EXPECT_LT(error[2], expected_error);
  EXPECT_NEAR(std::log2(error[0] / error[1]), std::log2(error[1] / error[2]), 0.1);
  return std::log2(error[1] / error[2]);
}

TEST(TimeIntegration, NewmarkIsOfSecondOrderForGammaOneHalfAndOfFirstBeyond) {
  DynamicOptions o;
  o.scheme = TimeScheme::newmark;
  EXPECT_NEAR(order(o, 1e-3), 2, 0.05);
  o.beta = 1.0 / 6;  // linear acceleration
  EXPECT_NEAR(order(o, 1e-3), 2, 0.05);
  // Damped at first order: the amplitude falls like exp(-(gamma - 1/2) omega^2 h t/2).
  SmallSystem s = oscillator(1);
  double amplitude[2];
  for (int k : {0, 1}) {
    o = {.scheme = TimeScheme::newmark, .beta = 0.3025, .gamma = 0.6};
    o.step_s = 2 * M_PI / (100 << k);
    o.end_s = 2 * M_PI;
    amplitude[k] = run(s, o, {0, {1}, {0}, {}}).y[0];
    EXPECT_NEAR(1 - amplitude[k], 0.1 * o.step_s * M_PI, 0.1 * 0.1 * o.step_s * M_PI);
  }
  EXPECT_NEAR((1 - amplitude[0]) / (1 - amplitude[1]), 2, 0.1);
}

TEST(TimeIntegration, GeneralisedAlphaIsOfSecondOrder) {
  for (double radius : {0.0, 0.5, 0.8, 1.0}) {
    DynamicOptions o;
    o.spectral_radius = radius;
    EXPECT_NEAR(order(o, 1e-2), 2, 0.1) << radius;
  }
}

TEST(TimeIntegration, ExplicitStepsAreOfSecondOrder) {
  DynamicOptions o;
  o.scheme = TimeScheme::explicit_verlet;
  EXPECT_NEAR(order(o, 1e-3), 2, 0.05);
}

/// The trapezoidal rule keeps the energy of a linear system exactly, whatever the step.
TEST(TimeIntegration, TrapezoidalRuleKeepsTheEnergyOfALinearSystem) {
  SmallSystem s = oscillator(3);
  DynamicOptions o{.scheme = TimeScheme::newmark, .step_s = 0.7, .end_s = 70};
  run(s, o, {0, {1}, {0.5}, {}}, [](const DynamicState& d) {
    EXPECT_NEAR(0.5 * d.v[0] * d.v[0] + 4.5 * d.y[0] * d.y[0], 4.625, 1e-9);
    return true;
  });
}

/// At omega h -> infinity all three eigenvalues of the amplification have the modulus r (Chung and Hulbert 1993):
/// amplitudes fall like n^2 r^n. At low frequency next to nothing is lost.
TEST(TimeIntegration, GeneralisedAlphaDampsHighFrequenciesAtItsSpectralRadius) {
  for (double radius : {0.4, 0.8}) {
    SmallSystem s = oscillator(1e6);
    const int from = radius < 0.5 ? 10 : 40;  // before rounding, and once n^2 r^n leads
    DynamicOptions o{.spectral_radius = radius, .step_s = 1, .end_s = 3.0 * from};
    double first = 0, last = 0;
    run(s, o, {0, {1}, {0}, {}}, [&](const DynamicState& d) {
      if (std::abs(d.time_s - from) < 1e-9) first = std::abs(d.y[0]);
      last = std::abs(d.y[0]);
      return true;
    });
    EXPECT_NEAR(std::pow(last / first / 9, 1.0 / (2 * from)), radius, 0.02 * radius);
    SmallSystem slow = oscillator(1);
    o = {.spectral_radius = radius, .step_s = 2 * M_PI / 100, .end_s = 20 * M_PI};
    EXPECT_GT(run(slow, o, {0, {1}, {0}, {}}).y[0], 0.98);
  }
}

/// y_n = cos(n theta), sin(theta/2) = omega h/2: what the scheme itself gives.
TEST(TimeIntegration, ExplicitStepsAreTheDiscreteOscillator) {
  SmallSystem s = oscillator(2);
  DynamicOptions o{.scheme = TimeScheme::explicit_verlet, .step_s = 0.35, .end_s = 35};
  const double theta = 2 * std::asin(0.35);
  int n = 0;
  run(s, o, {0, {1}, {0}, {}}, [&](const DynamicState& d) {
    EXPECT_NEAR(d.y[0], std::cos(++n * theta), 1e-11);
    return true;
  });
  EXPECT_EQ(n, 100);
}

/// 10,000 steps at a quarter of the critical one: the mean energy of the last tenth against the first tenth, and the
/// fluctuation falls with the square of the step.
TEST(TimeIntegration, ExplicitStepsKeepTheEnergyInTheMean) {
  SmallSystem s = duffing();
  const double critical = 2 / std::sqrt(1 + 3 * 1.5 * 1.5);
  double deviation[2];
  for (int k : {0, 1}) {
    const int steps = 10000 << k;
    DynamicOptions o{.scheme = TimeScheme::explicit_verlet, .step_s = critical / (4 << k)};
    o.end_s = steps * o.step_s;
    double first = 0, last = 0, kinetic = 0, most = 0;
    int n = 0;
    const double energy0 = duffingEnergy({0, {1.5}, {0}, {}});
    run(s, o, {0, {1.5}, {0}, {}}, [&](const DynamicState& d) {
      (n < steps / 10            ? first
       : n >= steps - steps / 10 ? last
                                 : most) +=
          n < steps / 10 || n >= steps - steps / 10 ? duffingEnergy(d) / (steps / 10) : 0;
      most = std::max(most, std::abs(duffingEnergy(d) - energy0));
      kinetic = std::max(kinetic, 0.5 * d.v[0] * d.v[0]);
      ++n;
      return true;
    });
    EXPECT_LT(std::abs(last - first), 1e-3 * kinetic);
    deviation[k] = most;
  }
  EXPECT_GT(deviation[0] / deviation[1], 3.5);
}

/// y'' + d y' + omega^2 y = 0 with d = a + b omega^2.
TEST(TimeIntegration, RayleighDampingAgreesWithTheClosedForm) {
  const double omega = 2, end = 4;
  const auto exact = [&](double d) {
    const double w = std::sqrt(omega * omega - d * d / 4);
    return std::exp(-d * end / 2) * (std::cos(w * end) + d / (2 * w) * std::sin(w * end));
  };
  SmallSystem s = oscillator(omega);
  s.rayleigh_mass = 0.3;
  for (TimeScheme scheme : {TimeScheme::newmark, TimeScheme::generalised_alpha, TimeScheme::explicit_verlet})
    EXPECT_NEAR(run(s, {.scheme = scheme, .step_s = 1e-3, .end_s = end}, {0, {1}, {0}, {}}).y[0], exact(0.3), 1e-5);
  s.rayleigh_stiffness = 0.1;
  for (TimeScheme scheme : {TimeScheme::newmark, TimeScheme::generalised_alpha})
    EXPECT_NEAR(run(s, {.scheme = scheme, .step_s = 1e-3, .end_s = end}, {0, {1}, {0}, {}}).y[0], exact(0.7), 1e-5);
  DynamicState state{0, {1}, {0}, {}};
  EXPECT_THROW(integrate(s, {.scheme = TimeScheme::explicit_verlet}, state, [](const DynamicState&) { return true; }),
               InputError);
}

/// A chain of 50 masses held at both ends: omega_max = 2 sqrt(k/m) sin(50 pi/(2 51)).
TEST(TimeIntegration, TheStableStepIsThatOfTheHighestMode) {
  const int n = 50;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) = 2;
    if (i + 1 < n) K(i, i + 1) = K(i + 1, i) = -1;
  }
  SmallSystem s = linearSystem(K, Eigen::VectorXd::Zero(n));
  const double omega = 2 * std::sin(n * M_PI / (2.0 * (n + 1)));
  DynamicOptions o{.scheme = TimeScheme::explicit_verlet, .safety = 1, .end_s = 200};
  std::vector<double> times;
  DynamicState start;
  start.y.assign(n, 0.0);
  start.v = start.y;
  start.y[7] = 1e-3;
  const DynamicState end = run(s, o, start, [&](const DynamicState& d) {
    times.push_back(d.time_s);
    return true;
  });
  EXPECT_NEAR(times[1] - times[0], 2 / omega, 0.01 * 2 / omega);
  // At 1.1 of the stable step the motion grows without bound.
  o.step_s = 1.1 * 2 / omega;
  double most = 0;
  run(s, o, start, [&](const DynamicState& d) {
    most = std::max(most, std::abs(d.y[7]));
    return true;
  });
  EXPECT_GT(most, 1e3);
}

/// A mass on the spring f = y + 1e4 y^3, thrown from y = 0 with v = 1: slope 1 there, 425 where it turns, so that the
/// step of the start is 20 times the stable one of the turn. Its energy 1/2 is kept; steps of the start's length lose
/// it by orders. A free chain beside it keeps the mass a small part of all that moves.
TEST(TimeIntegration, TheStepFollowsAStiffnessThatRises) {
  const int n = 6;
  SmallSystem s(n);
  s.force = [](const Eigen::VectorXd& y) -> Eigen::VectorXd {
    Eigen::VectorXd f = y;
    f(0) += 1e4 * y(0) * y(0) * y(0);
    return f;
  };
  s.tangent = [n](const Eigen::VectorXd& y) -> Eigen::MatrixXd {
    Eigen::MatrixXd K = Eigen::MatrixXd::Identity(n, n);
    K(0, 0) += 3e4 * y(0) * y(0);
    return K;
  };
  DynamicState start;
  start.y.assign(n, 0.0);
  start.v = start.y;
  start.v[0] = 1;
  start.y[3] = 1;
  std::vector<double> times{0.0}, energies;
  DynamicOptions o{.scheme = TimeScheme::explicit_verlet, .safety = 0.5, .end_s = 20};
  run(s, o, start, [&](const DynamicState& d) {
    EXPECT_GT(d.time_s, times.back());  // steps that were done again are not shown
    times.push_back(d.time_s);
    const double y = d.y[0], v = d.v[0];
    energies.push_back(0.5 * v * v + 0.5 * y * y + 2500 * y * y * y * y);
    return true;
  });
  EXPECT_EQ(times.back(), 20);
  for (const double e : energies) EXPECT_NEAR(e, 0.5, 0.1);
  EXPECT_NEAR(energies.back(), 0.5, 0.1);
}

/// Newton with few iterations fails in whole steps of a hard spring; halved ones pass, and the end is met exactly.
TEST(TimeIntegration, StepsThatFailAreHalved) {
  SmallSystem s(1);
  s.force = [](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, y(0) + 1e4 * std::pow(y(0), 3)); };
  s.tangent = [](const Eigen::VectorXd& y) { return Eigen::MatrixXd::Constant(1, 1, 1 + 3e4 * y(0) * y(0)); };
  double shortest = 1, before = 0;
  DynamicOptions o{.scheme = TimeScheme::newmark, .step_s = 0.5, .end_s = 2, .iterations = 5};
  run(s, o, {0, {0}, {5}, {}}, [&](const DynamicState& d) {
    shortest = std::min(shortest, d.time_s - before);
    before = d.time_s;
    EXPECT_LT(std::abs(d.y[0]), 1);
    return true;
  });
  EXPECT_LE(shortest, 0.25);
  // A force that ends at y = 0.3: the report says why, and the last accepted state is left.
  s.force = [](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, y(0) < 0.3 ? y(0) : NAN); };
  DynamicState state{0, {0}, {5}, {}};
  const DynamicReport r = integrate(s, o, state, [](const DynamicState&) { return true; });
  EXPECT_FALSE(r.reached);
  EXPECT_NE(r.why.find("residual"), std::string::npos) << r.why;
  EXPECT_NE(r.why.find("not finite"), std::string::npos) << r.why;
  EXPECT_TRUE(std::isfinite(state.v[0]));
  EXPECT_GT(state.y[0], 0.29);
  EXPECT_LT(state.y[0], 0.3);
  // Explicit steps too.
  state = {0, {0}, {5}, {}};
  const DynamicReport e = integrate(s, {.scheme = TimeScheme::explicit_verlet, .step_s = 1e-3}, state,
                                    [](const DynamicState&) { return true; });
  EXPECT_FALSE(e.reached);
  EXPECT_NE(e.why.find("not finite"), std::string::npos) << e.why;
  EXPECT_GT(state.y[0], 0.29);
}

TEST(TimeIntegration, RefusesWhatIsNotAScheme) {
  SmallSystem s = oscillator(1);
  const auto refuse = [&](const DynamicOptions& o) {
    DynamicState state{0, {1}, {0}, {}};
    EXPECT_THROW(integrate(s, o, state, [](const DynamicState&) { return true; }), InputError);
  };
  refuse({.scheme = TimeScheme::newmark, .beta = 0, .step_s = 0.1});
  refuse({.scheme = TimeScheme::newmark, .gamma = 0.4, .step_s = 0.1});
  refuse({.spectral_radius = 1.1, .step_s = 0.1});
  refuse({.step_s = 0});
  refuse({.step_s = NAN});
  refuse({.step_s = 0.1, .end_s = 0});
  refuse({.scheme = TimeScheme::explicit_verlet, .safety = 1.5});
  DynamicState wrong{0, {1, 2}, {0}, {}};
  EXPECT_THROW(integrate(s, {.step_s = 0.1}, wrong, [](const DynamicState&) { return true; }), InputError);
}

}  // namespace
}  // namespace gambeson
