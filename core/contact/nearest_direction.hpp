#pragma once
/// The direction between the nearest points of two primitives. Detail of certified_impact.hpp, for host and device.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/contact/certified_impact.hpp"

namespace gambeson::certified {

constexpr double kNormalised = 1e-200;  ///< squared length from which a vector has a direction

/// The differences x_i - x_j between the corners of the two primitives: N = 3 (p - a, p - b, p - c) or
/// N = 4 (a - c, a - d, b - c, b - d). The primitives meet where the hull of these points holds the origin; the hull is
/// a triangle or a parallelogram, and its nearest point to the origin tells the nearest points of the primitives.
template <std::size_t N>
using Relative = std::array<Vec3, N>;

template <std::size_t N>
GAMBESON_HD Relative<N> relative(const FourPoints& x) {
  if constexpr (N == 3)
    return {x[0] - x[1], x[0] - x[2], x[0] - x[3]};
  else
    return {x[0] - x[2], x[0] - x[3], x[1] - x[2], x[1] - x[3]};
}

GAMBESON_HD inline double largest(const Vec3& a) {
  return std::max(std::max(std::abs(a.x), std::abs(a.y)), std::abs(a.z));
}

/// A unit vector, from the hull towards the origin's other side: n.r > 0 on the hull where it separates.
struct Direction {
  Vec3 n;
  double u = 0, v = 0;  ///< of the nearest points that it belongs to
  double length_m = 0;  ///< their distance
  bool valid = false;
};

/// Nearest point of a line segment r0 r1 to the origin: r0 + s (r1 - r0), made orthogonal to the segment anew, as the
/// difference of long vectors leaves a direction that is not.
struct SegmentFoot {
  double s, length2;
  Vec3 q;
};
GAMBESON_HD inline SegmentFoot footOnSegment(const Vec3& r0, const Vec3& r1) {
  const Vec3 e = r1 - r0;
  const double along = -dot(r0, e), length2 = norm2(e);
  if (!(along > 0)) return {0, norm2(r0), r0};
  if (!(along < length2)) return {1, norm2(r1), r1};
  const double s = along / length2;
  Vec3 q = r0 + s * e;
  q -= (dot(q, e) / length2) * e;
  return {s, norm2(q), q};
}

GAMBESON_HD inline void orient(Direction& d, const Vec3& q, double length2) {
  d.valid = length2 > kNormalised;
  if (!d.valid) return;
  d.length_m = std::sqrt(length2);
  d.n = (1 / d.length_m) * q;
}

/// The direction of the plane of the hull, with the foot of the origin on it; `inside` where the foot is in the hull.
GAMBESON_HD inline Direction planeDirection(const Vec3& normal, const Vec3& r) {
  Direction d;
  orient(d, normal, norm2(normal));
  if (!d.valid) return d;
  d.length_m = dot(d.n, r);
  if (d.length_m < 0) {
    d.length_m = -d.length_m;
    d.n = -d.n;
  }
  return d;
}

GAMBESON_HD inline Direction faceDirection(const Relative<3>& r, bool& inside) {
  const Vec3 n = cross(r[0] - r[1], r[0] - r[2]);
  const double w0 = dot(n, cross(r[1], r[2])), w1 = dot(n, cross(r[2], r[0])), w2 = dot(n, cross(r[0], r[1]));
  Direction d = planeDirection(n, r[0]);
  inside = d.valid && w0 >= 0 && w1 >= 0 && w2 >= 0;
  if (inside) {
    const double sum = w0 + w1 + w2;
    d.u = sum > 0 ? w1 / sum : 1.0 / 3, d.v = sum > 0 ? w2 / sum : 1.0 / 3;
  }
  return d;
}

GAMBESON_HD inline Direction faceDirection(const Relative<4>& r, bool& inside) {
  const Vec3 e = r[2] - r[0], f = r[0] - r[1];  // b - a, d - c
  const Vec3 n = cross(e, f);
  const double n2 = norm2(n);
  Direction d = planeDirection(n, r[0]);
  const double s = dot(n, cross(f, r[0])), t = dot(n, cross(e, r[0]));
  inside = d.valid && s >= 0 && s <= n2 && t >= 0 && t <= n2;
  if (inside) d.u = s / n2, d.v = t / n2;
  return d;
}

GAMBESON_HD inline Direction rimDirection(const Relative<3>& r) {
  Direction d;
  const SegmentFoot ab = footOnSegment(r[0], r[1]), bc = footOnSegment(r[1], r[2]), ca = footOnSegment(r[2], r[0]);
  if (ab.length2 <= bc.length2 && ab.length2 <= ca.length2) {
    d.u = ab.s;
    orient(d, ab.q, ab.length2);
  } else if (bc.length2 <= ca.length2) {
    d.u = 1 - bc.s, d.v = bc.s;
    orient(d, bc.q, bc.length2);
  } else {
    d.v = 1 - ca.s;
    orient(d, ca.q, ca.length2);
  }
  return d;
}

GAMBESON_HD inline Direction rimDirection(const Relative<4>& r) {
  Direction d;
  SegmentFoot best = footOnSegment(r[0], r[1]);  // the corner a against cd
  d.u = 0, d.v = best.s;
  if (const SegmentFoot b = footOnSegment(r[2], r[3]); b.length2 < best.length2) best = b, d.u = 1, d.v = b.s;
  if (const SegmentFoot c = footOnSegment(r[0], r[2]); c.length2 < best.length2) best = c, d.u = c.s, d.v = 0;
  if (const SegmentFoot e = footOnSegment(r[1], r[3]); e.length2 < best.length2) best = e, d.u = e.s, d.v = 1;
  orient(d, best.q, best.length2);
  return d;
}

}  // namespace gambeson::certified
