#include "analysis/ticks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gambeson {
namespace {

TEST(Ticks, AreRoundWithinTheRangeAndAboutAsManyAsWanted) {
  for (const auto& [low, high] : {std::pair{0.0, 15.0}, {-0.37, 2.11}, {1e-7, 9e-7}, {-3e5, 8e5}, {12.34, 12.39}})
    for (int target = 2; target < 9; ++target) {
      const Ticks t = niceTicks(low, high, target);
      const double lead = t.step / std::pow(10.0, std::floor(std::log10(t.step) + 1e-9));
      EXPECT_TRUE(std::abs(lead - 1) < 1e-9 || std::abs(lead - 2) < 1e-9 || std::abs(lead - 5) < 1e-9) << t.step;
      ASSERT_GE(t.values.size(), 1u);
      EXPECT_LE(std::abs(double(t.values.size()) - target), target) << low << " " << high;
      EXPECT_GE(t.values.front(), low - 1e-6 * t.step);
      EXPECT_LE(t.values.back(), high + 1e-6 * t.step);
      // The next one would lie outside.
      EXPECT_GT(t.values.back() + t.step, high);
    }
}

TEST(Ticks, LabelsHaveTheDecimalsOfTheStep) {
  EXPECT_EQ(niceTicks(0, 1, 5).label(0.2), "0.2");
  EXPECT_EQ(niceTicks(0, 10, 5).label(4), "4");
  EXPECT_EQ(niceTicks(-1, 1, 4).label(-0.5), "\u22120.5");
  EXPECT_EQ(niceTicks(-1, 1, 4).label(-1e-17), "0.0");
  EXPECT_EQ(niceTicks(0, 0.1, 4).label(0.02), "0.02");
  EXPECT_EQ(niceTicks(0, 1e-4, 5).label(2e-5), "2e\u22125");
  EXPECT_EQ(niceTicks(0, 1.4e-4, 5).label(1.2e-4), "1.2e\u22124");
  EXPECT_EQ(niceTicks(0, 1e7, 5).label(2e6), "2e6");
}

TEST(Ticks, LabelsSideBySideDoNotTouch) {
  for (const double high : {9e-5, 8.9e-6, 9.1e7, 3.0})
    for (const double length : {200.0, 400.0}) {
      const Ticks t = ticksThatFit(0, high, 6, length, 7.4);
      ASSERT_GE(t.values.size(), 2u);
      // A sign of minus has three bytes.
      for (const double v : t.values) {
        const std::string label = t.label(v);
        const double characters =
            static_cast<double>(label.size()) - (label.find("\u2212") == std::string::npos ? 0 : 2);
        EXPECT_LT(7.4 * characters, t.step / high * length) << label << " " << length;
      }
    }
  EXPECT_EQ(ticksThatFit(0, 1, 6, 400, 7.4).step, niceTicks(0, 1, 6).step);
}

TEST(Numbers, HaveSignificantDigits) {
  EXPECT_EQ(formatNumber(1.8349), "1.83");
  EXPECT_EQ(formatNumber(-0.0041849), "\u22120.00418");
  EXPECT_EQ(formatNumber(12345), "12300");
  EXPECT_EQ(formatNumber(0), "0");
  EXPECT_EQ(formatNumber(1e-9, 2), "1.0e\u22129");
  EXPECT_EQ(formatNumber(1000), "1000");
  EXPECT_EQ(formatNumber(std::numeric_limits<double>::quiet_NaN()), "not a number");
  EXPECT_EQ(formatNumber(-std::numeric_limits<double>::infinity()), "\u2212infinite");
}

TEST(Ticks, BriefNumbersHaveNoZerosAtTheEnd) {
  EXPECT_EQ(formatBrief(5, 2), "5");
  EXPECT_EQ(formatBrief(80), "80");
  EXPECT_EQ(formatBrief(0.25), "0.25");
  EXPECT_EQ(formatBrief(1200), "1200");
  EXPECT_EQ(formatBrief(0), "0");
}

}  // namespace
}  // namespace gambeson
