/// What a light may show of its number.

#include "analysis/trust.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gambeson {
namespace {

TEST(Trust, GreenOnlyWhereEverythingHolds) {
  Trust t;
  t.check(true, true);
  t.stretch({0.02, 0.01, 0.02});
  EXPECT_TRUE(t.whole());
  EXPECT_EQ(shownLight(Light::green, t), Light::green);
  Trust stretched = t;
  stretched.stretch({0.02, 0.01, 0.021});
  EXPECT_TRUE(stretched.reliable());
  EXPECT_EQ(shownLight(Light::green, stretched), Light::doubtful);
  EXPECT_EQ(shownLight(Light::amber, stretched), Light::amber);
  Trust failing = t;
  failing.check(false, false);
  EXPECT_FALSE(failing.reliable());
  EXPECT_EQ(shownLight(Light::green, failing), Light::doubtful);
  EXPECT_EQ(shownLight(Light::red, failing), Light::red);
  failing.check(false, true);
  for (const Light light : {Light::green, Light::amber, Light::red})
    EXPECT_EQ(shownLight(light, failing), Light::unknown);
}

TEST(Trust, StretchThatIsNoNumberDoesNotHold) {
  EXPECT_FALSE((Stretch{0.02, 0.01, std::nan("")}.holds()));
  EXPECT_TRUE((Stretch{0.02, 0.01, 0.02}.holds()));
}

TEST(Trust, StretchIsToldWithItsRange) {
  EXPECT_EQ(
      sentenceOf(Stretch{0.15, 0.21, 0.73, true, "shirt", "weft"}),
      "The fabric of shirt stretches by up to 73 % along its weft (99 % of it by less than 21 %), and it is meant "
      "for less than 15 %: it may not come back, or tear.");
  const Stretch all[]{{0.02, 0.01, 0.03}, {0.5, 0.1, 0.6}, {0.02, 0.01, 0.019}};
  EXPECT_EQ(worstOf(all), all);  // 1.5 times its range
  EXPECT_EQ(worstOf({}), nullptr);
}

}  // namespace
}  // namespace gambeson
