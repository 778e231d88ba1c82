/// Rounding outwards.
#include "gpu/finding/float_box.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gambeson::gpu {
namespace {

TEST(FloatBox, NextBelowIsTheNextNumber) {
  for (const float x : {1.0f, -1.0f, 1.5f, 0.0f, -0.0f, 1e-45f, -1e-45f, 1e-38f, 3e38f, -3e38f, INFINITY})
    EXPECT_EQ(nextBelow(x), std::nextafter(x, -INFINITY)) << x;
  EXPECT_EQ(nextBelow(-INFINITY), -INFINITY);
}

TEST(FloatBox, RoundsOutwardsAndNoFurther) {
  std::mt19937_64 rng(3);
  std::uniform_real_distribution<double> mantissa(-2, 2);
  for (int i = 0; i < 100000; ++i) {
    const double x = i % 5 ? std::ldexp(mantissa(rng), static_cast<int>(rng() % 80) - 40) : std::round(mantissa(rng));
    const float down = roundedDown(x, 0), up = roundedUp(x, 0);
    ASSERT_LE(down, x);
    ASSERT_GE(up, x);
    ASSERT_GT(std::nextafter(down, INFINITY), x) << "the largest that is not above";
    ASSERT_LT(std::nextafter(up, -INFINITY), x);
    const float margin = std::ldexp(1.3f, static_cast<int>(rng() % 60) - 40);
    // Exact in long double, 64 bits, where the two are not too far apart.
    ASSERT_LE(static_cast<long double>(roundedDown(x, margin)), static_cast<long double>(x) - margin);
    ASSERT_GE(static_cast<long double>(roundedUp(x, margin)), static_cast<long double>(x) + margin);
  }
}

TEST(FloatBox, BoxesThatTouchMeetAndEmptyOnesDoNot) {
  const FloatBox a = boxOf({{0, 0, 0}, {1, 1, 1}}, 0), b = boxOf({{1, 0.5, 2}, {2, 0.5, 1}}, 0);
  EXPECT_TRUE(meet(a, b));
  EXPECT_FALSE(meet(a, boxOf({{1.001, 0.5, 1}, {2, 0.5, 1}}, 0)));
  EXPECT_TRUE(meet(a, boxOf({{1.001, 0.5, 1}, {2, 0.5, 1}}, 1e-3f)));
  EXPECT_FALSE(meet(a, emptyBox()));
}

}  // namespace
}  // namespace gambeson::gpu
