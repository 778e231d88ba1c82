#pragma once
/// Paths of samples into a moving ellipsoid, one at a time, for host and device. Detail of proximity.hpp
/// (ProximityQuery::impacts), which states the law.

#include <optional>

#include "core/contact/box.hpp"
#include "core/contact/ellipsoid_foot.hpp"

namespace gambeson {

/// First time in [0, 1] at which the straight path p0 -> p1 enters the ellipsoid from outside: the first root of the
/// quadratic |p(t)/e|^2 = 1. A start on the surface (within 1e-10 of it in |p/e|^2) counts as outside where the motion
/// is inward; a start inside, and a path that only grazes, do not enter.
GAMBESON_HD inline std::optional<double> ellipsoidEntry(const EllipsoidMetric& s, const Vec3& p0, const Vec3& p1) {
  const auto unit = [&](const Vec3& v) { return Vec3{v.x * s.inverse.x, v.y * s.inverse.y, v.z * s.inverse.z}; };
  const Vec3 a = unit(p0), b = unit(p1 - p0);
  const double A = norm2(b), B = dot(a, b), C = norm2(a) - 1;
  if (!(B < 0) || !(C >= -1e-10)) return std::nullopt;
  if (C <= 0) return 0.0;
  // B^2 - A C = A - |a x b|^2: the second form does not cancel far from the surface.
  const double disc = A - norm2(cross(a, b));
  if (!(disc > 0)) return std::nullopt;
  const double t = C / (-B + std::sqrt(disc));
  if (t <= 1) return t;
  return std::nullopt;
}

/// A box around the ellipsoid where it stands: the support function |diag(e) R^T axis|, larger by the rounding of the
/// placement.
GAMBESON_HD inline Box boxAround(const Vec3& semi_axes, const Placement& X) {
  const Mat3& R = X.rotation;
  Vec3 h;
  for (int i = 0; i < 3; ++i) h[i] = X.scale * norm({R.a[i] * semi_axes.x, R.b[i] * semi_axes.y, R.c[i] * semi_axes.z});
  const Box box{X.origin - h, X.origin + h};
  return box.grown(1e-12 * (norm(h) + norm(X.origin)));
}

/// Where an ellipsoid is during a step, and how far from there a path may be that is one of its frame's chords.
///
/// The path is the chord in the obstacle's frame, p(t) = (1 - t) p0 + t p1 with x0 = X0 p0, x1 = X1 p1. Under the
/// interpolated map Xt = (1 - t) X0 + t X1 (affine, linear part At) a point of the shape lies in the hull of the
/// shape's two boxes, and Xt p(t) = (1 - t) x0 + t x1 - t (1 - t) (A1 - A0) (p1 - p0). So the world chord comes within
/// |A1 - A0| |p1 - p0| / 4 of that hull wherever the local chord touches the shape, where
/// |p1 - p0| <= |x1 - x0|/s1 + |o1 - o0|/s1 + |A1^-1 - A0^-1| |x0 - o0|.
struct EllipsoidSweep {
  Box hull;
  double bend = 0, per_motion = 0, shift = 0, turn = 0;

  /// Whether points that start in `starts` and move within `path` by up to `step_m` may touch the ellipsoid, which
  /// starts at `origin`: no is certain in spite of rounding.
  GAMBESON_HD bool mayMeet(const Box& starts, const Box& path, double step_m, const Vec3& origin) const {
    double margin = 0;
    if (bend > 0) {
      constexpr double kSlack = 1 + 1e-9;
      const Vec3 far = maximum(starts.hi - origin, origin - starts.lo);
      margin = bend * (step_m * per_motion + shift + turn * norm(far)) * kSlack;
    }
    return overlap(path.grown(margin), hull);
  }
};

GAMBESON_HD inline EllipsoidSweep sweepOf(const EllipsoidMetric& e, const Placement& X0, const Placement& X1) {
  const auto minus = [](const Mat3& m, double s, const Mat3& n, double r) {
    return Mat3{s * m.a - r * n.a, s * m.b - r * n.b, s * m.c - r * n.c};
  };
  const auto frobenius = [](const Mat3& m) { return std::sqrt(norm2(m.a) + norm2(m.b) + norm2(m.c)); };
  EllipsoidSweep s;
  s.hull = boxAround(e.semi_axes, X0);
  s.hull.add(boxAround(e.semi_axes, X1));
  s.bend = frobenius(minus(X1.rotation, X1.scale, X0.rotation, X0.scale)) / 4;
  s.per_motion = 1 / X1.scale;
  s.shift = norm(X1.origin - X0.origin) / X1.scale;
  s.turn = frobenius(minus(X1.rotation, 1 / X1.scale, X0.rotation, 1 / X0.scale));
  return s;
}

/// A path that enters an ellipsoid.
struct EllipsoidHit {
  double time = 0;   ///< in [0, 1]
  Vec3 local;        ///< where, in the ellipsoid's frame
  Vec3 normal;       ///< of the surface there, as it stands at the start
  double gap_m = 0;  ///< of the start of the path along that normal
};

/// Whether the path p0 -> p1, in the frame of the ellipsoid, enters it; `start`: where that stands at first.
GAMBESON_HD inline bool pathEnters(const EllipsoidMetric& e, const Placement& start, const Vec3& p0, const Vec3& p1,
                                   EllipsoidHit& hit) {
  const Box local{-e.semi_axes, e.semi_axes};
  Box path;
  path.add(p0), path.add(p1);
  if (!overlap(path.grown(1e-9 * norm(local.halfSize())), local)) return false;
  const std::optional<double> t = ellipsoidEntry(e, p0, p1);
  if (!t) return false;
  hit.time = *t;
  hit.local = p0 + *t * (p1 - p0);
  const Vec3 normal = normalized({hit.local.x * e.inverse2.x, hit.local.y * e.inverse2.y, hit.local.z * e.inverse2.z});
  hit.normal = start.rotation * normal;
  hit.gap_m = start.scale * dot(p0 - hit.local, normal);
  return true;
}

}  // namespace gambeson
