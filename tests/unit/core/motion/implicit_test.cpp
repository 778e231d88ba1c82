/// Newmark and generalised-alpha steps on oscillators with closed forms.

#include "core/motion/implicit.hpp"

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

SystemState run(
    System& system, const ImplicitOptions& options, double end_s, SystemState state,
    const SystemObserver& observe = [](const SystemState&) { return true; }) {
  const ImplicitReport r = integrate(system, options, end_s, state, observe);
  EXPECT_TRUE(r.reached) << r.why;
  EXPECT_EQ(state.time_s, end_s);
  return state;
}

/// Order of the velocity after one period, where it should be zero again.
double order(ImplicitOptions o, double expected_error) {
  SmallSystem s = duffing();
  const double end_s = duffingPeriod(1.5);
  double error[3];
  for (int k = 0; k < 3; ++k) {
    o.step_s = end_s / (200 << k);
    error[k] = std::abs(run(s, o, end_s, {0, {1.5}, {0}, {}}).v[0]);
  }
  EXPECT_LT(error[2], expected_error);
  EXPECT_NEAR(std::log2(error[0] / error[1]), std::log2(error[1] / error[2]), 0.1);
  return std::log2(error[1] / error[2]);
}

TEST(ImplicitSteps, NewmarkIsOfSecondOrderForGammaOneHalfAndOfFirstBeyond) {
  ImplicitOptions o;
  o.scheme = ImplicitScheme::newmark;
  EXPECT_NEAR(order(o, 1e-3), 2, 0.05);
  o.beta = 1.0 / 6;  // linear acceleration
  EXPECT_NEAR(order(o, 1e-3), 2, 0.05);
  // Damped at first order: the amplitude falls like exp(-(gamma - 1/2) omega^2 h t/2).
  SmallSystem s = oscillator(1);
  double amplitude[2];
  for (int k : {0, 1}) {
    o = {.scheme = ImplicitScheme::newmark, .beta = 0.3025, .gamma = 0.6};
    o.step_s = 2 * M_PI / (100 << k);
    amplitude[k] = run(s, o, 2 * M_PI, {0, {1}, {0}, {}}).y[0];
    EXPECT_NEAR(1 - amplitude[k], 0.1 * o.step_s * M_PI, 0.1 * 0.1 * o.step_s * M_PI);
  }
  EXPECT_NEAR((1 - amplitude[0]) / (1 - amplitude[1]), 2, 0.1);
}

TEST(ImplicitSteps, GeneralisedAlphaIsOfSecondOrder) {
  for (double radius : {0.0, 0.5, 0.8, 1.0}) {
    ImplicitOptions o;
    o.spectral_radius = radius;
    EXPECT_NEAR(order(o, 1e-2), 2, 0.1) << radius;
  }
}

/// The trapezoidal rule keeps the energy of a linear system exactly, whatever the step.
TEST(ImplicitSteps, TrapezoidalRuleKeepsTheEnergyOfALinearSystem) {
  SmallSystem s = oscillator(3);
  ImplicitOptions o{.scheme = ImplicitScheme::newmark, .step_s = 0.7};
  run(s, o, 70, {0, {1}, {0.5}, {}}, [](const SystemState& d) {
    EXPECT_NEAR(0.5 * d.v[0] * d.v[0] + 4.5 * d.y[0] * d.y[0], 4.625, 1e-9);
    return true;
  });
}

/// At omega h -> infinity all three eigenvalues of the amplification have the modulus r (Chung and Hulbert 1993):
/// amplitudes fall like n^2 r^n. At low frequency next to nothing is lost.
TEST(ImplicitSteps, GeneralisedAlphaDampsHighFrequenciesAtItsSpectralRadius) {
  for (double radius : {0.4, 0.8}) {
    SmallSystem s = oscillator(1e6);
    const int from = radius < 0.5 ? 10 : 40;  // before rounding, and once n^2 r^n leads
    ImplicitOptions o{.spectral_radius = radius, .step_s = 1};
    double first = 0, last = 0;
    run(s, o, 3.0 * from, {0, {1}, {0}, {}}, [&](const SystemState& d) {
      if (std::abs(d.time_s - from) < 1e-9) first = std::abs(d.y[0]);
      last = std::abs(d.y[0]);
      return true;
    });
    EXPECT_NEAR(std::pow(last / first / 9, 1.0 / (2 * from)), radius, 0.02 * radius);
    SmallSystem slow = oscillator(1);
    o = {.spectral_radius = radius, .step_s = 2 * M_PI / 100};
    EXPECT_GT(run(slow, o, 20 * M_PI, {0, {1}, {0}, {}}).y[0], 0.98);
  }
}

/// y'' + d y' + omega^2 y = 0 with d = a + b omega^2.
TEST(ImplicitSteps, RayleighDampingAgreesWithTheClosedForm) {
  const double omega = 2, end = 4;
  const auto exact = [&](double d) {
    const double w = std::sqrt(omega * omega - d * d / 4);
    return std::exp(-d * end / 2) * (std::cos(w * end) + d / (2 * w) * std::sin(w * end));
  };
  SmallSystem s = oscillator(omega);
  s.rayleigh_mass = 0.3;
  for (ImplicitScheme scheme : {ImplicitScheme::newmark, ImplicitScheme::generalised_alpha})
    EXPECT_NEAR(run(s, {.scheme = scheme, .step_s = 1e-3}, end, {0, {1}, {0}, {}}).y[0], exact(0.3), 1e-5);
  s.rayleigh_stiffness = 0.1;
  for (ImplicitScheme scheme : {ImplicitScheme::newmark, ImplicitScheme::generalised_alpha})
    EXPECT_NEAR(run(s, {.scheme = scheme, .step_s = 1e-3}, end, {0, {1}, {0}, {}}).y[0], exact(0.7), 1e-5);
}

/// y'' + b (1 + 3 y²) y' + y + y³ = 0: where the damping follows the motion within the step, the scheme keeps its
/// order.
TEST(ImplicitSteps, ADampingThatChangesIsOfSecondOrderToo) {
  SmallSystem s = duffing();
  s.rayleigh_stiffness = 0.1;
  for (const ImplicitScheme scheme : {ImplicitScheme::newmark, ImplicitScheme::generalised_alpha}) {
    double y[4];
    for (int k = 0; k < 4; ++k)
      y[k] = run(s, {.scheme = scheme, .step_s = 0.04 / (1 << k)}, 4, {0, {1.5}, {0}, {}}).y[0];
    const double first = std::abs(y[1] - y[0]), second = std::abs(y[2] - y[1]), third = std::abs(y[3] - y[2]);
    EXPECT_NEAR(std::log2(first / second), 2, 0.1);
    EXPECT_NEAR(std::log2(second / third), 2, 0.05);
  }
}

/// Newton with few iterations fails in whole steps of a hard spring; halved ones pass, and the end is met exactly.
TEST(ImplicitSteps, StepsThatFailAreHalved) {
  SmallSystem s(1);
  s.force = [](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, y(0) + 1e4 * std::pow(y(0), 3)); };
  s.tangent = [](const Eigen::VectorXd& y) { return Eigen::MatrixXd::Constant(1, 1, 1 + 3e4 * y(0) * y(0)); };
  double shortest = 1, before = 0;
  ImplicitOptions o{.scheme = ImplicitScheme::newmark, .step_s = 0.5, .iterations = 5};
  run(s, o, 2, {0, {0}, {5}, {}}, [&](const SystemState& d) {
    shortest = std::min(shortest, d.time_s - before);
    before = d.time_s;
    EXPECT_LT(std::abs(d.y[0]), 1);
    return true;
  });
  EXPECT_LE(shortest, 0.25);
  // A force that ends at y = 0.3: the report says why, and the last accepted state is left.
  s.force = [](const Eigen::VectorXd& y) { return Eigen::VectorXd::Constant(1, y(0) < 0.3 ? y(0) : NAN); };
  SystemState state{0, {0}, {5}, {}};
  const ImplicitReport r = integrate(s, o, 2, state, [](const SystemState&) { return true; });
  EXPECT_FALSE(r.reached);
  EXPECT_NE(r.why.find("residual"), std::string::npos) << r.why;
  EXPECT_NE(r.why.find("not finite"), std::string::npos) << r.why;
  EXPECT_TRUE(std::isfinite(state.v[0]));
  EXPECT_GT(state.y[0], 0.29);
  EXPECT_LT(state.y[0], 0.3);
}

TEST(ImplicitSteps, RefusesWhatIsNotAScheme) {
  SmallSystem s = oscillator(1);
  const auto refuse = [&](const ImplicitOptions& o, double end_s = 1) {
    SystemState state{0, {1}, {0}, {}};
    EXPECT_THROW(integrate(s, o, end_s, state, [](const SystemState&) { return true; }), InputError);
  };
  refuse({.scheme = ImplicitScheme::newmark, .beta = 0, .step_s = 0.1});
  refuse({.scheme = ImplicitScheme::newmark, .gamma = 0.4, .step_s = 0.1});
  refuse({.spectral_radius = 1.1, .step_s = 0.1});
  refuse({.step_s = 0});
  refuse({.step_s = NAN});
  refuse({.step_s = 0.1}, 0);
  SystemState wrong{0, {1, 2}, {0}, {}};
  EXPECT_THROW(integrate(s, {.step_s = 0.1}, 1, wrong, [](const SystemState&) { return true; }), InputError);
}

}  // namespace
}  // namespace gambeson
