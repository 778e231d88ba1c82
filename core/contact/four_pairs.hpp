#pragma once
/// Four pairs of primitives at once, in single precision: for each a direction that separates them, and how far.

#include <array>
#include <cmath>
#include <span>

#include "core/contact/tile.hpp"

namespace gambeson {

struct FourVec {
  Four x{}, y{}, z{};

  friend FourVec operator-(const FourVec& a, const FourVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend FourVec operator+(const FourVec& a, const FourVec& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend FourVec operator*(const Four& s, const FourVec& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend Four dot(const FourVec& a, const FourVec& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend FourVec cross(const FourVec& a, const FourVec& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend FourVec choose(const FourBits& m, const FourVec& a, const FourVec& b) {
    return {m ? a.x : b.x, m ? a.y : b.y, m ? a.z : b.z};
  }
};

/// Corner by corner: where it is in each of the four pairs.
using FourCorners = std::array<FourVec, 4>;

inline FourCorners gather(std::span<const MovingPoint> points, const std::array<std::array<int, 4>, 4>& vertex,
                          Four MovingPoint::*when) {
  FourCorners out;
  for (int k = 0; k < 4; ++k) {
    Four a = points[vertex[0][k]].*when, b = points[vertex[1][k]].*when, c = points[vertex[2][k]].*when,
         d = points[vertex[3][k]].*when;
    transpose(a, b, c, d);
    out[k] = {a, b, c};
  }
  return out;
}

namespace four {
constexpr float kLeast = 1e-30f;  ///< in place of lengths that are 0
inline Four clamped(const Four& t) { return least(most(t, all(0)), all(1)); }
/// The vector to p from the nearest point of the line segment from a to a + e.
inline FourVec fromSegment(const FourVec& p, const FourVec& a, const FourVec& e) {
  const FourVec r = p - a;
  return r - clamped(dot(r, e) / most(dot(e, e), all(kLeast))) * e;
}
}  // namespace four

/// From the nearest point of the line segment between corners 2 and 3 to that of the segment between 0 and 1.
inline FourVec wayOfEdges(const FourCorners& p) {
  using four::clamped;
  const FourVec u = p[1] - p[0], v = p[3] - p[2], r = p[0] - p[2];
  const Four uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), ur = dot(u, r), vr = dot(v, r);
  const Four det = uu * vv - uv * uv;
  const Four s0 = det > all(1e-6f) * uu * vv ? clamped((uv * vr - ur * vv) / most(det, all(four::kLeast))) : all(0.5f);
  const Four t = clamped((uv * s0 + vr) / most(vv, all(four::kLeast)));
  const Four s = clamped((uv * t - ur) / most(uu, all(four::kLeast)));
  return r + s * u - t * v;
}

/// From the nearest point of the triangle of corners 1, 2, 3 to corner 0.
inline FourVec wayOfPoint(const FourCorners& p) {
  const FourVec e = p[2] - p[1], f = p[3] - p[1], g = p[3] - p[2], n = cross(e, f), r = p[0] - p[1], q = p[0] - p[2];
  const FourVec a = four::fromSegment(p[0], p[1], e), b = four::fromSegment(p[0], p[1], f),
                c = four::fromSegment(p[0], p[2], g);
  const FourVec ab = choose(dot(a, a) < dot(b, b), a, b);
  const FourVec rim = choose(dot(c, c) < dot(ab, ab), c, ab);
  const FourBits over =
      (dot(cross(n, e), r) > all(0)) & (dot(cross(n, g), q) > all(0)) & (dot(cross(f, n), r) > all(0));
  return choose(over, (dot(r, n) / most(dot(n, n), all(four::kLeast))) * n, rim);
}

/// How far the first `A` corners lie beyond the others along n.
template <int A>
Four gapAlong(const FourCorners& p, const FourVec& n) {
  Four nearest = dot(n, p[0]), farthest = dot(n, p[A]);
  for (int k = 1; k < A; ++k) nearest = least(nearest, dot(n, p[k]));
  for (int k = A + 1; k < 4; ++k) farthest = most(farthest, dot(n, p[k]));
  return nearest - farthest;
}

struct FourGaps {
  Four now, then;
};
/// Gaps of pairs of a point and a triangle (A = 1) or of two edges (A = 2), along one direction for all times. Of pairs
/// that touch, 0.
template <int A>
FourGaps gapsOf(std::span<const MovingPoint> points, const std::array<std::array<int, 4>, 4>& vertex) {
  const FourCorners now = gather(points, vertex, &MovingPoint::now), then = gather(points, vertex, &MovingPoint::then);
  FourVec n;
  if constexpr (A == 1)
    n = wayOfPoint(now);
  else
    n = wayOfEdges(now);
  const Four length2 = dot(n, n);
  const Four scale = length2 > all(four::kLeast) ? all(1) / root(length2) : Four{};
  n = scale * n;
  return {gapAlong<A>(now, n), gapAlong<A>(then, n)};
}

}  // namespace gambeson
