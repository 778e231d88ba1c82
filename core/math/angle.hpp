#pragma once
/// The angle between two vectors from basic operations alone, so that host and device have the same bits.

#include <algorithm>

#include "core/math/vec.hpp"

namespace gambeson {

/// atan s for |s| <= sqrt(2) - 1, by its series: what is left out is below 3e-19.
GAMBESON_HD inline double arcTangentOfSmall(double s) {
  constexpr int kTerms = 22;
  const double z = -s * s;
  double sum = 0;
  for (int n = kTerms - 1; n >= 0; --n) sum = 1.0 / (2 * n + 1) + z * sum;
  return s * sum;
}

/// The angle of (x, y), y >= 0, from the x axis, in [0, pi]; 0 at the origin. Off by a few units of rounding.
GAMBESON_HD inline double angleOf(double y, double x) {
  constexpr double kQuarter = 0.78539816339744830962;
  const double ax = std::abs(x), more = std::max(ax, y), less = std::min(ax, y);
  if (!(more > 0)) return 0;
  const double t = less / more;
  double angle = t > 0.41421356237309504880 ? kQuarter + arcTangentOfSmall((t - 1) / (t + 1)) : arcTangentOfSmall(t);
  if (y > ax) angle = 2 * kQuarter - angle;
  return x < 0 ? 4 * kQuarter - angle : angle;
}

}  // namespace gambeson
