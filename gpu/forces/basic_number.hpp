#pragma once
/// A double whose sine, cosine and angle are made of basic operations: for laws that search with them, such as the
/// tension field (core/material/laws/tension_field.hpp), with the same bits on every device.

#include <cmath>

#include "gpu/device/unroll.hpp"
#include "gpu/forces/angle.hpp"

namespace gambeson::gpu {

/// Sine and cosine of |x| < 1e5 rad, within 2 units in the last place of 1. x is taken to r = x - k pi/2 in [-pi/4,
/// pi/4] by pi/2 in two parts, and the series of r go to r^17 and r^16: off by 2e-18 at most.
struct SineCosine {
  double sine, cosine;
  GAMBESON_HD explicit SineCosine(double x) {
    constexpr double per_quarter = 0.6366197723675814, high = 1.5707963267341256, low = 6.077100506506192e-11;
    const double k = ::floor(x * per_quarter + 0.5), r = ::fma(-k, low, ::fma(-k, high, x)), z = r * r;
    double s = 0, c = 0;  // s = (sin r - r)/(r z), c = (cos r - 1)/z
    GAMBESON_UNROLL
    for (int n = 17; n >= 3; n -= 2) s = ::fma(s, z, ((n / 2) % 2 == 1 ? -1.0 : 1.0) / factorial(n));
    GAMBESON_UNROLL
    for (int n = 18; n >= 2; n -= 2) c = ::fma(c, z, ((n / 2) % 2 == 1 ? -1.0 : 1.0) / factorial(n));
    s = ::fma(r * z, s, r);
    c = ::fma(z, c, 1.0);
    const int quarter = static_cast<int>(k - 4 * ::floor(0.25 * k));
    sine = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
    cosine = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
  }

 private:
  /// Exact. No recursion: with that a kernel's stack has no known size, and runs over.
  GAMBESON_HD static constexpr double factorial(int n) {
    double product = 1;
    for (int k = 2; k <= n; ++k) product *= k;
    return product;
  }
};

struct Basic {
  double value = 0;
  Basic() = default;
  GAMBESON_HD Basic(double x) : value(x) {}  // NOLINT: numbers are numbers
  GAMBESON_HD Basic operator-() const { return -value; }
  GAMBESON_HD Basic& operator+=(Basic b) { return value += b.value, *this; }
  GAMBESON_HD Basic& operator*=(Basic b) { return value *= b.value, *this; }
  GAMBESON_HD friend Basic operator+(Basic a, Basic b) { return a.value + b.value; }
  GAMBESON_HD friend Basic operator-(Basic a, Basic b) { return a.value - b.value; }
  GAMBESON_HD friend Basic operator*(Basic a, Basic b) { return a.value * b.value; }
  GAMBESON_HD friend Basic operator/(Basic a, Basic b) { return a.value / b.value; }
  GAMBESON_HD friend bool operator<(Basic a, Basic b) { return a.value < b.value; }
  GAMBESON_HD friend bool operator>(Basic a, Basic b) { return a.value > b.value; }
  GAMBESON_HD friend bool operator>=(Basic a, Basic b) { return a.value >= b.value; }
  GAMBESON_HD friend Basic fabs(Basic a) { return ::fabs(a.value); }
  GAMBESON_HD friend Basic sqrt(Basic a) { return ::sqrt(a.value); }
  GAMBESON_HD friend Basic sin(Basic a) { return SineCosine(a.value).sine; }
  GAMBESON_HD friend Basic cos(Basic a) { return SineCosine(a.value).cosine; }
  GAMBESON_HD friend Basic atan2(Basic y, Basic x) {
    return y.value == 0 && x.value == 0 ? 0.0 : angleOf(y.value, x.value);
  }
};

}  // namespace gambeson::gpu
