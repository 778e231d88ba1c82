#pragma once
/// Axis-aligned boxes.

#include <algorithm>
#include <limits>

#include "core/math/vec.hpp"

namespace gambeson {

GAMBESON_HD inline Vec3 minimum(const Vec3& a, const Vec3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
GAMBESON_HD inline Vec3 maximum(const Vec3& a, const Vec3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// Empty by default.
struct Box {
  Vec3 lo{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
          std::numeric_limits<double>::infinity()};
  Vec3 hi{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
          -std::numeric_limits<double>::infinity()};

  GAMBESON_HD void add(const Vec3& p) { lo = minimum(lo, p), hi = maximum(hi, p); }
  GAMBESON_HD void add(const Box& b) { lo = minimum(lo, b.lo), hi = maximum(hi, b.hi); }
  GAMBESON_HD Box grown(double by) const { return {lo - Vec3{by, by, by}, hi + Vec3{by, by, by}}; }
  GAMBESON_HD Vec3 centre() const { return 0.5 * (lo + hi); }
  GAMBESON_HD Vec3 halfSize() const { return 0.5 * (hi - lo); }
  /// The i-th of 8 corners.
  GAMBESON_HD Vec3 corner(int i) const { return {i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z}; }
  bool operator==(const Box&) const = default;
};

GAMBESON_HD inline bool overlap(const Box& a, const Box& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y && a.lo.z <= b.hi.z &&
         b.lo.z <= a.hi.z;
}

/// Squared distance from a point to a box, 0 inside.
GAMBESON_HD inline double boxDistance2(const Box& b, const Vec3& p) {
  const Vec3 d = maximum(maximum(b.lo - p, p - b.hi), Vec3{});
  return norm2(d);
}

}  // namespace gambeson
