#pragma once
/// Roots of basic operations: the same bits on every device, and a third of what a division costs.
///
/// A quotient in single precision, which rounds alike everywhere, starts one step of third order in double: an error e
/// of the start becomes e^3. Numbers whose float is not well inside of its range take the division.

#include <cmath>

#include "core/math/vec.hpp"

namespace gambeson::gpu {

/// Whether the float of x > 0 and of its reciprocal are normal numbers.
GAMBESON_HD inline bool fitsFloat(double x) { return x > 1e-30 && x < 1e30; }

/// 1/sqrt(x) for x > 0, within 1 unit in the last place.
GAMBESON_HD inline double inverseRoot(double x) {
  if (!fitsFloat(x)) return 1 / ::sqrt(x);
  const double y = 1.0f / ::sqrtf(static_cast<float>(x));
  const double e = ::fma(-(x * y), y, 1.0);  // 1 - x y^2: y (1 - e)^(-1/2)
  return ::fma(y * e, ::fma(0.375, e, 0.5), y);
}

/// sqrt(x) for x > 0, within 2 units in the last place.
GAMBESON_HD inline double quickRoot(double x) { return x * inverseRoot(x); }

}  // namespace gambeson::gpu
