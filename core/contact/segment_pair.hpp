#pragma once
/// The nearest points of two line segments.

#include <algorithm>

#include "core/math/vec.hpp"

namespace gambeson {

/// Points a + s (b - a) and c + t (d - c).
struct SegmentPair {
  double s = 0, t = 0;
  double dist2_m2 = 0;
};

/// Nearest points of ab and cd; where they are parallel, one of the nearest pairs. Accurate to rounding unless the
/// segments are nearly parallel, where s and t (not the distance) are undetermined.
GAMBESON_HD inline SegmentPair nearestOnSegments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, r = a - c;
  const double uu = norm2(u), vv = norm2(v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  const double det = uu * vv - uv * uv;
  double s = det > 1e-14 * uu * vv ? std::clamp((uv * vr - ur * vv) / det, 0.0, 1.0) : 0.5;
  // The best t for this s, then the best s for that t: exact at the borders.
  const double t = vv > 0 ? std::clamp((uv * s + vr) / vv, 0.0, 1.0) : 0;
  s = uu > 0 ? std::clamp((uv * t - ur) / uu, 0.0, 1.0) : 0;
  return {s, t, norm2(r + s * u - t * v)};
}

}  // namespace gambeson
