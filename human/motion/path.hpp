#pragma once
/// A value over equal steps of time with its rates; cubic Hermite between (C¹).

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

template <class Value>
struct HermitePath {
  double step_s = 0;
  std::vector<Value> x, v;
  Value at(double t) const {
    const int n = static_cast<int>(x.size()) - 1;
    const int i = std::clamp(static_cast<int>(t / step_s), 0, n - 1);
    const double u = t / step_s - i, w = 1 - u;
    return w * w * (1 + 2 * u) * x[i] + u * u * (1 + 2 * w) * x[i + 1] +
           step_s * (u * w * w * v[i] - u * u * w * v[i + 1]);
  }
};

/// The way from x at `begin` with velocity(t), over `length`: Simpson's rule over steps of about 2 ms, at least 16.
template <class Velocity>
HermitePath<Vec3> integrated(double begin, double length, Vec3 x, const Velocity& velocity) {
  const int n = std::max(16, static_cast<int>(std::ceil(length / 0.002)));
  HermitePath<Vec3> path{length / n, {x}, {velocity(begin)}};
  for (int i = 0; i < n; ++i) {
    const double t = begin + (i + 1) * path.step_s;
    const Vec3 middle = velocity(t - 0.5 * path.step_s), end = velocity(t);
    x += path.step_s / 6 * (path.v.back() + 4 * middle + end);
    path.x.push_back(x);
    path.v.push_back(end);
  }
  return path;
}

/// Rates at the nodes by central differences of fourth order (second next to the ends), one-sided of second order at
/// the ends. At least three values.
template <class Value>
std::vector<Value> slopesOf(const std::vector<Value>& x, double step_s) {
  const std::size_t n = x.size();
  std::vector<Value> v(n);
  for (std::size_t i = 1; i + 1 < n; ++i)
    v[i] = i >= 2 && i + 2 < n ? (8.0 * (x[i + 1] - x[i - 1]) - (x[i + 2] - x[i - 2])) / (12 * step_s)
                               : (x[i + 1] - x[i - 1]) / (2 * step_s);
  v[0] = (4.0 * x[1] - 3.0 * x[0] - x[2]) / (2 * step_s);
  v[n - 1] = (3.0 * x[n - 1] - 4.0 * x[n - 2] + x[n - 3]) / (2 * step_s);
  return v;
}

}  // namespace gambeson
