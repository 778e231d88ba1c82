/// Angles from basic operations alone.
#include "core/math/angle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace gambeson {
namespace {

TEST(Angle, IsThatOfTheMathematicsLibraryToRounding) {
  std::mt19937 rng(5);
  std::uniform_real_distribution<double> even(-1, 1), power(-12, 12);
  double worst = 0;
  for (int k = 0; k < 200000; ++k) {
    const double y = std::abs(even(rng)) * std::pow(10.0, k % 3 == 0 ? power(rng) : 0), x = even(rng);
    const double truth = std::atan2(y, x);
    worst = std::max(worst, std::abs(angleOf(y, x) - truth) / truth);
  }
  EXPECT_LT(worst, 4 * std::numeric_limits<double>::epsilon());
}

TEST(Angle, IsExactWhereItIsKnown) {
  const double quarter = std::atan2(1.0, 1.0);
  EXPECT_EQ(angleOf(0, 0), 0);
  EXPECT_EQ(angleOf(0, 1), 0);
  EXPECT_EQ(angleOf(1, 0), 2 * quarter);
  EXPECT_EQ(angleOf(1, 1), quarter);
  EXPECT_EQ(angleOf(0, -1), 4 * quarter);
}

}  // namespace
}  // namespace gambeson
