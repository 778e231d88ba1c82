/// Exponents and elasticities of synthetic laws.

#include "analysis/compare.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gambeson {
namespace {

TEST(Compare, APowerLawGivesItsExponentExactly) {
  const std::vector<double> t{1, 0.5, 0.75};  // in any order
  std::vector<double> tau;
  for (const double x : t) tau.push_back(2.7 * std::pow(x, 1.58));
  const auto law = fitPowerLaw(t, tau);
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 1.58, 1e-12);
  EXPECT_NEAR(law->standard_error, 0, 1e-7);
  EXPECT_NEAR(law->lowest, 1.58, 1e-12);
  EXPECT_NEAR(law->highest, 1.58, 1e-12);
  EXPECT_EQ(law->points, 3);
}

/// 56 % in proportion and 44 % with the cube is no power law: its slope is t tau'/tau, 1.18 at 0.5 and 1.88 at 1, and
/// the range between neighbours lies within.
TEST(Compare, WhatIsNoPowerLawShowsASpread) {
  const std::vector<double> t{0.5, 0.75, 1};
  std::vector<double> tau;
  for (const double x : t) tau.push_back(0.56 * x + 0.44 * x * x * x);
  const auto slope = [](double x) { return (0.56 * x + 3 * 0.44 * x * x * x) / (0.56 * x + 0.44 * x * x * x); };
  const auto law = fitPowerLaw(t, tau);
  ASSERT_TRUE(law);
  EXPECT_GT(law->lowest, slope(0.5));
  EXPECT_LT(law->highest, slope(1));
  EXPECT_LT(law->lowest, law->exponent);
  EXPECT_GT(law->highest, law->exponent);
  EXPECT_GT(law->standard_error, 0.01);
  // Half the thickness leaves a third (Zheng 2013, section 6.4): 0.335.
  EXPECT_NEAR(tau[0] / tau[2], 1.0 / 3, 0.01);
}

/// Least squares by hand: ln y = 0, 1, 1 over ln x = 0, 1, 2 has slope 1/2, residuals -1/6, 1/3, -1/6.
/// A curve that falls and rises again is no power; one that is level but for a little is the power 0.
TEST(Compare, ACurveThatTurnsIsNoPower) {
  EXPECT_TRUE(fitPowerLaw(std::vector{1.0, 2.0, 4.0}, std::vector{2.0, 1.0, 1.5})->turns());
  EXPECT_FALSE(fitPowerLaw(std::vector{1.0, 2.0, 4.0}, std::vector{1.0, 1.5, 4.0})->turns());
  EXPECT_FALSE(fitPowerLaw(std::vector{1.0, 2.0, 4.0}, std::vector{1.0, 1.01, 1.0})->turns());
}

TEST(Compare, LeastSquaresAndItsErrorByHand) {
  const double e = std::exp(1.0);
  const auto law = fitPowerLaw(std::vector{1.0, e, e * e}, std::vector{1.0, e, e});
  ASSERT_TRUE(law);
  EXPECT_NEAR(law->exponent, 0.5, 1e-12);
  EXPECT_NEAR(law->standard_error, std::sqrt((1.0 / 36 + 1.0 / 9 + 1.0 / 36) / 1 / 2), 1e-12);
  EXPECT_NEAR(law->lowest, 0, 1e-12);
  EXPECT_NEAR(law->highest, 1, 1e-12);
}

TEST(Compare, WhatCannotBeFittedIsNotFitted) {
  EXPECT_FALSE(fitPowerLaw(std::vector{1.0}, std::vector{1.0}));
  EXPECT_FALSE(fitPowerLaw(std::vector{1.0, 1.0}, std::vector{1.0, 2.0}));
  EXPECT_FALSE(fitPowerLaw(std::vector{0.5, 1.0}, std::vector{0.0, 2.0}));
  EXPECT_FALSE(fitPowerLaw(std::vector{0.5, 1.0}, std::vector{std::nan(""), 2.0}));
  EXPECT_FALSE(fitPowerLaw(std::vector{-0.5, 1.0}, std::vector{1.0, 2.0}));
  const auto two = fitPowerLaw(std::vector{0.5, 1.0}, std::vector{1.0, 2.0});
  ASSERT_TRUE(two);
  EXPECT_NEAR(two->exponent, 1, 1e-12);
  EXPECT_TRUE(std::isnan(two->standard_error));  // two points have no error of their own
}

/// A torque that is linear in five forces: its elasticities are their parts of it, and sum to 1.
TEST(Compare, ElasticitiesOfALinearLawAreItsPartsAndSumToOne) {
  const double parts[]{0.31, 0.22, 0.28, 0.15, 0.04};
  const auto torque = [&](int factor, double value) {
    double tau = 0;
    for (int k = 0; k < 5; ++k) tau += parts[k] * (k == factor ? value : 1);
    return 3.2 * tau;
  };
  Elasticities e;
  std::optional<double>* const all[]{&e.bending, &e.membrane, &e.weight, &e.inertia, &e.drag};
  for (int k = 0; k < 5; ++k) *all[k] = elasticity(0.9, 1.1, torque(k, 0.9), torque(k, 1.1));
  // The central difference of ln(1 - p + p f) about 1 errs by less than p h^2.
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(**all[k], parts[k], 0.01 * parts[k]);
  EXPECT_NEAR(*e.sum(), 1, 0.005);
  EXPECT_NEAR(*e.thicknessExponent(), 0.22 + 0.28 + 0.15 + 3 * 0.31, 0.01);
  const auto measured = [&](double t) { return 3.2 * ((0.22 + 0.28 + 0.15) * t + 0.31 * t * t * t + 0.04); };
  EXPECT_NEAR(*elasticity(0.99, 1.01, measured(0.99), measured(1.01)), *e.thicknessExponent(), 0.01);
}

TEST(Compare, MissingElasticitiesMakeNoSum) {
  Elasticities e;
  e.bending = 0.4;
  e.membrane = 0.2;
  e.weight = 0.3;
  EXPECT_FALSE(e.sum());
  EXPECT_FALSE(e.thicknessExponent());
  e.inertia = 0.1;
  EXPECT_FALSE(e.sum());
  EXPECT_NEAR(*e.thicknessExponent(), 0.6 + 1.2, 1e-12);  // drag does not go with the thickness
  EXPECT_FALSE(elasticity(0.9, 1.1, 0, 1));
  EXPECT_FALSE(elasticity(1, 1, 1, 1));
}

TEST(Compare, Lights) {
  EXPECT_EQ(lightOf(0.04, 0.05, 0.15), Light::green);
  EXPECT_EQ(lightOf(0.05, 0.05, 0.15), Light::amber);
  EXPECT_EQ(lightOf(0.15, 0.05, 0.15), Light::amber);
  EXPECT_EQ(lightOf(0.16, 0.05, 0.15), Light::red);
  EXPECT_EQ(lightOf(std::nan(""), 0.05, 0.15), Light::unknown);
  EXPECT_EQ(lightOf({}, 0.05, 0.15), Light::unknown);
}

}  // namespace
}  // namespace gambeson
