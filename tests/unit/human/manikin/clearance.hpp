#pragma once
/// A lower bound of the distance between two ellipsoids, sharp at convergence.

#include <cmath>

#include "human/body/body.hpp"

namespace gambeson::test {

/// The nearest point of a solid ellipsoid: y_i a_i² / (t + a_i²) with the t >= 0 that puts it on the surface.
inline Vec3 nearest(const Vec3& a, const Vec3& y) {
  const auto level = [&](double t) {
    double s = 0;
    for (int i = 0; i < 3; ++i) s += std::pow(a[i] * y[i] / (t + a[i] * a[i]), 2);
    return s;
  };
  if (level(0) <= 1) return y;
  double lo = 0, hi = 1e-6;
  while (level(hi) > 1) hi *= 2;
  for (int k = 0; k < 60; ++k) (level(0.5 * (lo + hi)) > 1 ? lo : hi) = 0.5 * (lo + hi);
  Vec3 x;
  for (int i = 0; i < 3; ++i) x[i] = y[i] * a[i] * a[i] / (hi + a[i] * a[i]);
  return x;
}

/// Alternating projections give a direction n; the gap between the supporting planes across n bounds the distance from
/// below.
inline double clearance(const Ellipsoid& e1, const Pose& X1, const Ellipsoid& e2, const Pose& X2) {
  Vec3 p = X1.origin, q = X2.origin;
  for (int k = 0; k < 60; ++k) {
    p = X1 * nearest(e1.semi_axes, inverse(X1) * q);
    q = X2 * nearest(e2.semi_axes, inverse(X2) * p);
  }
  if (norm(q - p) < 1e-9) return 0;
  const Vec3 n = normalized(q - p);
  const auto support = [](const Ellipsoid& e, const Pose& X, const Vec3& d) {
    const Vec3 l = transposeTimes(X.rotation, d);
    return dot(d, X.origin) + std::sqrt(std::pow(e.semi_axes.x * l.x, 2) + std::pow(e.semi_axes.y * l.y, 2) +
                                        std::pow(e.semi_axes.z * l.z, 2));
  };
  return -support(e2, X2, -n) - support(e1, X1, n);
}

/// The smallest clearance between the shapes whose names start with any of `left` and with any of `right`.
inline double clearance(const Human& h, std::span<const Pose> X_WL, std::initializer_list<const char*> left,
                        std::initializer_list<const char*> right) {
  double least = 1e9;
  for (const BodyShape& s : h.shapes)
    for (const BodyShape& t : h.shapes)
      for (const char* l : left)
        for (const char* r : right)
          if (s.name.starts_with(l) && t.name.starts_with(r))
            least = std::min(least, clearance(std::get<Ellipsoid>(s.shape), X_WL[s.link] * s.X_LS,
                                              std::get<Ellipsoid>(t.shape), X_WL[t.link] * t.X_LS));
  return least;
}

}  // namespace gambeson::test
