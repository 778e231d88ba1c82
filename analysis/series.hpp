#pragma once
/// Statistics of a quantity over time: values[i] at time_s[i], times ascending.

#include <span>
#include <string>

namespace gambeson {

/// The value of largest magnitude, with its sign, the first where several are equal; and when.
struct Peak {
  double value = 0, time_s = 0;
};
Peak peakOf(std::span<const double> time_s, std::span<const double> values);

/// sqrt(Σ x²/n); 0 for an empty series.
double rms(std::span<const double> values);

/// (max - min)/2; 0 for an empty series.
double amplitude(std::span<const double> values);

/// How alike two courses are.
struct Likeness {
  double correlation = 0;     ///< Pearson's; NaN where one of them is constant
  double rms_difference = 0;  ///< of b - a, in the unit of the values
  double relative = 0;        ///< rms_difference / rms(a); NaN where a is 0 throughout
  int samples = 0;
};

/// Compares a(t) with b(t + shift_s) for the samples t of [from_s, to_s), b interpolated linearly. Samples for which b
/// is not known are left out. The second stride against the first: a = b, shift = period, [start, start + period).
/// Right against left: shift = half a period.
Likeness compareShifted(std::span<const double> time_s, std::span<const double> a, std::span<const double> b,
                        double shift_s, double from_s, double to_s);

/// amplitude(moving) / amplitude(still): how far a signal stands out of the noise of a standing run. Infinite where the
/// still one does not move at all.
double noiseRatio(std::span<const double> moving, std::span<const double> still);

/// "hip_flexion_left" for "hip_flexion_right" and back; empty where the name ends on neither.
std::string otherSide(const std::string& joint);

}  // namespace gambeson
