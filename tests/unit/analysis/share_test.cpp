/// Wilson's interval against published values and against what it must cover.

#include "analysis/share.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gambeson {
namespace {

/// Newcombe 1998 (Statistics in Medicine 17, 857), table I, method 3: score without continuity correction.
TEST(Share, IsThePublishedInterval) {
  const struct {
    int yes, of;
    double low, high;
  } published[]{{81, 263, 0.2553, 0.3662}, {15, 148, 0.0624, 0.1605}, {0, 20, 0, 0.1611}, {1, 29, 0.0061, 0.1718}};
  for (const auto& p : published) {
    EXPECT_NEAR(wilsonInterval(p.yes, p.of).low, p.low, 5e-5) << p.yes << " of " << p.of;
    EXPECT_NEAR(wilsonInterval(p.yes, p.of).high, p.high, 5e-5) << p.yes << " of " << p.of;
  }
}

TEST(Share, IsTheSameSeenFromTheOtherSide) {
  for (int k = 0; k <= 24; ++k) {
    const ShareInterval i = wilsonInterval(k, 24), other = wilsonInterval(24 - k, 24);
    EXPECT_NEAR(i.low, 1 - other.high, 1e-15);
    EXPECT_LE(i.low, k / 24.);
    EXPECT_GE(i.high, k / 24.);
  }
  EXPECT_EQ(wilsonInterval(0, 0).low, 0);
  EXPECT_EQ(wilsonInterval(0, 0).high, 1);
}

/// The ends are those shares from which what is seen is 1.96 standard deviations away.
TEST(Share, EndsAreWhereTheSampleIsOneQuantileOff) {
  const ShareInterval i = wilsonInterval(17, 24);
  for (const double p : {i.low, i.high})
    EXPECT_NEAR(std::abs(17 - 24 * p) / std::sqrt(24 * p * (1 - p)), 1.959963984540054, 1e-12);
}

}  // namespace
}  // namespace gambeson
