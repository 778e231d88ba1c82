#include "human/motion/periodic_spline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gambeson {
namespace {

std::vector<double> sampled(int n) {
  std::vector<double> x(n);
  for (int i = 0; i < n; ++i) x[i] = std::exp(std::sin(2 * std::numbers::pi * i / n));
  return x;
}
double exact(double p) { return std::exp(std::sin(2 * std::numbers::pi * p)); }

TEST(PeriodicSpline, GoesThroughItsValuesAndRepeats) {
  const auto x = sampled(50);
  const PeriodicSpline s(x);
  for (int i = 0; i < 50; ++i) {
    EXPECT_NEAR(s.at(i / 50.0), x[i], 1e-12);
    EXPECT_NEAR(s.at(i / 50.0 - 3), x[i], 1e-12);
  }
  EXPECT_NEAR(s.at(1 - 1e-12), s.at(0), 1e-9);
}

// A cubic spline of a smooth function converges with the fourth power of the step (de Boor, A Practical Guide to
// Splines, ch. V).
TEST(PeriodicSpline, ConvergesWithFourthOrder) {
  const auto error = [](int n) {
    const PeriodicSpline s(sampled(n));
    double e = 0;
    for (int i = 0; i < 1000; ++i) e = std::max(e, std::abs(s.at(i / 1000.0 + 1e-4) - exact(i / 1000.0 + 1e-4)));
    return e;
  };
  EXPECT_GT(std::log2(error(40) / error(80)), 3.8);
}

TEST(PeriodicSpline, SecondDerivativeIsContinuousAtKnotsAndOverThePeriod) {
  const int n = 12;
  const PeriodicSpline s(sampled(n));
  const double h = 1e-4;
  const auto curvature = [&](double p) { return (s.at(p - h) - 2 * s.at(p) + s.at(p + h)) / (h * h); };
  for (int i = 0; i < n; ++i) {
    const double p = static_cast<double>(i) / n;
    EXPECT_NEAR(curvature(p - 1.1 * h), curvature(p + 1.1 * h), 0.2) << i;  // third derivative about 400 times 2.2 h
  }
}

}  // namespace
}  // namespace gambeson
