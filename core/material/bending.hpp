#pragma once
/// Moment against curvature of a fabric, one direction at a time.

#include "core/math/vec.hpp"

namespace gambeson {

/// Zheng 2013, eq. 2.14 and 2.14', moment per length m [N] of a curvature k [1/m]:
///   m = 2 B0 sqrt(k0 |k|) sign(k),  kr <= |k| <= k0;   m = B0 (|k| + k0) sign(k),  |k| > k0.
/// The root has an infinite slope at k = 0. Below the regularising curvature kr it is replaced by the odd cubic
///   m = 2 B0 sqrt(k0/kr) k (5/4 - (k/kr)^2/4),
/// which meets it at kr with the same value and slope; the law is C1, and its steepest slope is 5/2 B0 sqrt(k0/kr) at k
/// = 0. Valid for B0 >= 0 [N m], 0 < kr <= k0 [1/m].
GAMBESON_HD inline double zhengMoment(double k, double b0, double k0, double kr) {
  const double a = k < 0 ? -k : k;
  const double m = a > k0   ? b0 * (a + k0)
                   : a > kr ? 2 * b0 * std::sqrt(k0 * a)
                            : 2 * b0 * std::sqrt(k0 / kr) * a * (1.25 - 0.25 * (a / kr) * (a / kr));
  return k < 0 ? -m : m;
}

/// The energy per area of zhengMoment [N/m], zero at k = 0.
GAMBESON_HD inline double zhengEnergy(double k, double b0, double k0, double kr) {
  const double a = k < 0 ? -k : k;
  const double below = a < kr ? a : kr, ratio2 = (below / kr) * (below / kr);
  double e = 2 * b0 * std::sqrt(k0 / kr) * below * below * (0.625 - 0.0625 * ratio2);
  if (a > kr) {
    const double mid = a < k0 ? a : k0;
    e += 4.0 / 3.0 * b0 * std::sqrt(k0) * (mid * std::sqrt(mid) - kr * std::sqrt(kr));
  }
  if (a > k0) e += b0 * (0.5 * (a * a - k0 * k0) + k0 * (a - k0));
  return e;
}

/// The slope dm/dk of zhengMoment [N m]; at the joints that of both sides, for the law is C1. Never negative: at kr the
/// cubic's slope is B0 sqrt(k0/kr).
GAMBESON_HD inline double zhengSlope(double k, double b0, double k0, double kr) {
  const double a = k < 0 ? -k : k;
  return a > k0   ? b0
         : a > kr ? b0 * std::sqrt(k0 / a)
                  : 2 * b0 * std::sqrt(k0 / kr) * (1.25 - 0.75 * (a / kr) * (a / kr));
}

/// The steepest slope dm/dk of zhengMoment, at k = 0 [N m]; what a stable time step must allow for.
GAMBESON_HD inline double zhengSteepest(double b0, double k0, double kr) { return 2.5 * b0 * std::sqrt(k0 / kr); }

}  // namespace gambeson
