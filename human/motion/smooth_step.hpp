#pragma once
/// Smooth ways from 0 to 1.

#include <algorithm>

namespace gambeson {

/// 0 to 1 with zero first and second derivatives at both ends, 6 s⁵ - 15 s⁴ + 10 s³ (minimum jerk); constant outside.
inline double smootherStep(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * (s * (6 * s - 15) + 10);
}
/// Its integral from 0 to s <= 1: s⁶ - 3 s⁵ + 2.5 s⁴.
inline double smootherArea(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * s * s * (s * (s - 3) + 2.5);
}
/// 0 at both ends and outside, 1 in the middle, with zero first and second derivatives at the ends: 64 s³ (1 - s)³.
inline double smoothBump(double s) {
  s = std::clamp(s, 0.0, 1.0);
  const double a = s * (1 - s);
  return 64 * a * a * a;
}

}  // namespace gambeson
