// The bending law against Zheng 2013, eq. 2.14, and its regularisation.
#include "core/material/laws/zheng_bending.hpp"

#include <gtest/gtest.h>

namespace gambeson {
namespace {

constexpr double kB0 = 3.0e-6, kK0 = 200.0, kKr = 8.0;  // N m, 1/m, 1/m

Answer<double, 1> zheng(double k) {
  Answer<double, 1> answer;
  zhengCurve<all_parts>(kB0, kK0, kKr, k, answer);
  return answer;
}
double zhengMoment(double k) { return zheng(k).resultant[0]; }
double zhengEnergy(double k) { return zheng(k).energy; }
double zhengSlope(double k) { return zheng(k).slope[0]; }

TEST(BendingLaw, IsEquation214AboveTheRegularisingCurvature) {
  for (double k : {8.0, 20.0, 199.9}) EXPECT_DOUBLE_EQ(zhengMoment(k), 2 * kB0 * std::sqrt(kK0 * k));
  for (double k : {200.1, 500.0, 1e4}) EXPECT_DOUBLE_EQ(zhengMoment(k), kB0 * (k + kK0));
}

TEST(BendingLaw, MomentIsOddAndEnergyEven) {
  for (double k : {0.0, 1.0, 7.99, 8.0, 50.0, 200.0, 1000.0}) {
    EXPECT_EQ(zhengMoment(-k), -zhengMoment(k));
    EXPECT_EQ(zhengEnergy(-k), zhengEnergy(k));
  }
  EXPECT_EQ(zhengEnergy(0), 0);
}

TEST(BendingLaw, MomentIsTheSlopeOfTheEnergy) {
  for (double k = -480.5; k < 500; k += 1.7) {
    const double h = 1e-3;
    const auto e = [&](double x) { return zhengEnergy(x); };
    const double slope = (8 * (e(k + h) - e(k - h)) - (e(k + 2 * h) - e(k - 2 * h))) / (12 * h);
    EXPECT_NEAR(slope, zhengMoment(k), 1e-8 * kB0 * kK0) << "at " << k;
  }
}

/// Value and one-sided slopes at the two joints; the slopes have the closed forms B0 sqrt(k0/kr) and B0.
TEST(BendingLaw, IsC1AtBothJoints) {
  const auto m = [](double k) { return zhengMoment(k); };
  const double h = 1e-6;
  for (const auto& [joint, slope] : {std::pair{kKr, kB0 * std::sqrt(kK0 / kKr)}, std::pair{kK0, kB0}}) {
    EXPECT_NEAR(m(joint * (1 + 1e-14)), m(joint * (1 - 1e-14)), 1e-12 * m(joint));
    EXPECT_NEAR((m(joint * (1 + h)) - m(joint)) / (joint * h), slope, 1e-5 * slope);
    EXPECT_NEAR((m(joint) - m(joint * (1 - h))) / (joint * h), slope, 1e-5 * slope);
    const auto e = [](double k) { return zhengEnergy(k); };
    EXPECT_NEAR(e(joint * (1 + 1e-14)), e(joint * (1 - 1e-14)), 1e-12 * e(joint));
  }
}

TEST(BendingLaw, SlopeIsTheDerivativeOfTheMoment) {
  const auto m = [](double k) { return zhengMoment(k); };
  for (double k : {-450.0, -199.0, -50.0, -8.5, -7.5, -0.1, 0.0, 0.3, 5.0, 7.9, 8.1, 60.0, 199.0, 201.0, 900.0}) {
    const double h = 1e-3;
    const double slope = (8 * (m(k + h) - m(k - h)) - (m(k + 2 * h) - m(k - 2 * h))) / (12 * h);
    EXPECT_NEAR(zhengSlope(k), slope, 1e-8 * kB0 * kK0) << "at " << k;
  }
  EXPECT_DOUBLE_EQ(zhengSlope(kKr), kB0 * std::sqrt(kK0 / kKr));
  EXPECT_DOUBLE_EQ(zhengSlope(0), zhengSteepest(kB0, kK0, kKr));
}

TEST(BendingLaw, NoSlopeIsSteeperThanAtZero) {
  const double steepest = zhengSteepest(kB0, kK0, kKr);
  EXPECT_NEAR(zhengMoment(1e-6 * kKr) / (1e-6 * kKr), steepest, 1e-9 * steepest);
  for (double k = 0; k < 300; k += 0.5) EXPECT_LE(zhengMoment(k + 0.5) - zhengMoment(k), 0.5 * steepest);
}

/// The area under eq. 2.14 without regularisation: 4/3 B0 sqrt(k0) k^1.5 up to k0. The regularised root lies below it
/// by (4/3 - 9/8) B0 sqrt(k0 kr) kr = 5/24 B0 sqrt(k0 kr) kr.
TEST(BendingLaw, EnergyLiesBelowTheRootByAKnownAmount) {
  const double k = 100;
  const double root = 4.0 / 3.0 * kB0 * std::sqrt(kK0) * std::pow(k, 1.5),
               less = 5.0 / 24.0 * kB0 * std::sqrt(kK0 * kKr) * kKr;
  EXPECT_NEAR(root - zhengEnergy(k), less, 1e-10 * root);
}

}  // namespace
}  // namespace gambeson
