#pragma once
/// What one says of courses in time: pure functions of numbers, for what a study or a reference asks of them.

#include <span>
#include <vector>

namespace gambeson {

/// A quantity over time, times ascending.
struct Course {
  std::vector<double> time_s, value;
};

/// Linear between the neighbouring times. Throws RunError where the course does not reach `t_s`.
double valueAt(const Course& course, double t_s);

/// The part of [from_s, to_s]. Throws RunError where nothing of it was recorded, or a value is not finite.
Course within(const Course& course, double from_s, double to_s);

/// `course` at the times t + shift_s of `times`, and at those of `times` for which it is known (`times` loses the
/// others). Throws RunError where there are none.
Course resampled(const Course& course, Course& times, double shift_s);

/// Pearson's; NaN where one of them is constant.
double correlation(std::span<const double> a, std::span<const double> b);

/// Spearman's: Pearson's of the ranks, equal values sharing the mean of their ranks. 1 for all that rises.
double rankCorrelation(std::span<const double> a, std::span<const double> b);

/// sqrt(mean (b - a)^2) / max |a|.
double differenceOverPeak(std::span<const double> a, std::span<const double> b);

/// max |a|, and the first place of it.
struct Largest {
  double value = 0;
  std::size_t at = 0;
};
Largest largestOf(std::span<const double> a);

/// The mean over the times, all of which have the same weight.
double meanOf(std::span<const double> a);

/// The part of the times at which a > b.
double greaterShare(std::span<const double> a, std::span<const double> b);

/// When |value| falls below half of its largest for good, linearly between the times; the last time where it does not.
double halfTime(const Course& course);

/// `difference` less the nearest whole number of periods: in [-period/2, period/2].
double wrapped(double difference, double period);

}  // namespace gambeson
