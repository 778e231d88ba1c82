#include "analysis/course.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

Course courseOf(int n, double dt, double (*f)(double)) {
  Course c;
  for (int i = 0; i < n; ++i) {
    c.time_s.push_back(dt * i);
    c.value.push_back(f(dt * i));
  }
  return c;
}

TEST(Course, ValuesLieOnStraightLinesBetweenTheRows) {
  const Course c{{0, 1, 3}, {2, 4, -2}};
  EXPECT_DOUBLE_EQ(valueAt(c, 0), 2);
  EXPECT_DOUBLE_EQ(valueAt(c, 0.25), 2.5);
  EXPECT_DOUBLE_EQ(valueAt(c, 2), 1);
  EXPECT_DOUBLE_EQ(valueAt(c, 3), -2);
  EXPECT_THROW(valueAt(c, 3.1), RunError);
  EXPECT_THROW(valueAt(c, -0.1), RunError);
  EXPECT_THROW(valueAt({}, 0), RunError);
}

TEST(Course, PartsKeepTheirEndsAndRefuseWhatIsNoNumber) {
  const Course c{{0, 1, 2, 3}, {5, 6, std::nan(""), 8}};
  EXPECT_EQ(within(c, 0, 1).value, (std::vector<double>{5, 6}));
  EXPECT_THROW(within(c, 0, 2), RunError);
  EXPECT_THROW(within(c, 4, 5), RunError);
}

TEST(Course, HalfAPeriodLaterTheOtherLegIsTheSame) {
  // cos(2 pi t/T) and the same half a period later: minus itself where it is not shifted.
  constexpr double T = 1.1;
  static constexpr auto right = [](double t) { return 3 * std::cos(2 * std::numbers::pi * t / T); };
  const Course r = courseOf(221, 0.01, right);
  Course l = courseOf(221, 0.01, [](double t) { return -right(t); });
  Course a = within(r, 0.5, 2.2);
  const Course b = resampled(l, a, T / 2);
  EXPECT_NEAR(a.time_s.back(), 2.2 - T / 2, 1e-9);  // beyond, the other is not known
  EXPECT_NEAR(correlation(a.value, b.value), 1, 1e-9);
  EXPECT_LT(differenceOverPeak(a.value, b.value), 1e-9);
  Course unshifted = within(r, 0.5, 2.2);
  const Course same = resampled(l, unshifted, 0);
  EXPECT_NEAR(correlation(unshifted.value, same.value), -1, 1e-9);
  Course none = within(r, 0, 0.1);
  EXPECT_THROW(resampled(l, none, 10), RunError);
}

TEST(Course, DifferencesAreMeasuredAgainstThePeakOfTheFirst) {
  const std::vector<double> a{0, -4, 0, 0}, b{1, -5, 1, 1};
  EXPECT_DOUBLE_EQ(differenceOverPeak(a, b), 0.25);
  EXPECT_DOUBLE_EQ(differenceOverPeak(b, a), 0.2);
  EXPECT_DOUBLE_EQ(largestOf(a).value, 4);
  EXPECT_EQ(largestOf(a).at, 1u);
}

TEST(Course, RanksSeeRisingWhateverItsShape) {
  std::vector<double> t, rising, falling, bent;
  for (int i = 0; i < 50; ++i) {
    t.push_back(0.1 * i);
    rising.push_back(std::exp(0.3 * i));
    falling.push_back(-rising.back());
    bent.push_back(std::abs(i - 25));
  }
  EXPECT_NEAR(rankCorrelation(t, rising), 1, 1e-12);
  EXPECT_LT(correlation(t, rising), 0.7);
  EXPECT_NEAR(rankCorrelation(t, falling), -1, 1e-12);
  EXPECT_LT(std::abs(rankCorrelation(t, bent)), 0.1);
  // Ties share the mean of their ranks: 1, 2.5, 2.5, 4 against 1, 2, 3, 4, by hand 4.5/sqrt(5 x 4.5).
  EXPECT_NEAR(rankCorrelation(std::vector<double>{1, 2, 3, 4}, std::vector<double>{7, 8, 8, 9}),
              4.5 / std::sqrt(5 * 4.5), 1e-12);
  EXPECT_TRUE(std::isnan(rankCorrelation(t, std::vector<double>(50, 1.0))));
}

TEST(Course, HalfTimeIsTheLastFallBelowHalfOfThePeak) {
  // Falls below 2, rises again to 3, falls for good between 4 s (3) and 5 s (-1): 3 - 2 of 3 - 1.
  EXPECT_NEAR(halfTime({{0, 1, 2, 3, 4, 5, 6}, {0, -4, -1, 2.5, 3, -1, 0}}), 4.5, 1e-12);
  EXPECT_NEAR(halfTime({{0, 1, 2}, {1, 2, 3}}), 2, 1e-12) << "does not fall";
}

TEST(Course, SharesAndWholePeriods) {
  EXPECT_DOUBLE_EQ(greaterShare(std::vector<double>{1, 2, 3, 4}, std::vector<double>{1, 1, 4, 0}), 0.5);
  EXPECT_NEAR(wrapped(0.95 - 0.02, 1), -0.07, 1e-12);
  EXPECT_NEAR(wrapped(2.3, 1), 0.3, 1e-12);
  EXPECT_NEAR(wrapped(-0.6, 1), 0.4, 1e-12);
  EXPECT_THROW(greaterShare(std::vector<double>{1}, std::vector<double>{1, 2}), std::logic_error);
}

}  // namespace
}  // namespace gambeson
