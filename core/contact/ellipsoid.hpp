#pragma once
/// Distance between a point and an ellipsoid that is aligned with its frame and centred at the frame's origin.

#include <optional>

#include "core/contact/obstacle.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// The point of a surface closest to a query point, the unit outward normal there, and the signed distance of the
/// query point (negative inside) [m].
struct SurfacePoint {
  Vec3 position;
  Vec3 normal;
  double distance_m = 0;
};

/// What the iteration needs of an ellipsoid, computed once: with e_m the smallest semi-axis,
/// `ratio_minus_1[i] = e_i^2/e_m^2 - 1`, without cancellation.
struct EllipsoidMetric {
  Vec3 semi_axes, inverse, inverse2, ratio_minus_1;
  int smallest = 0;
  double min_axis_m = 0;
};

/// Throws InputError unless every semi-axis is positive and finite.
EllipsoidMetric ellipsoidMetric(const Ellipsoid& shape);

/// Closest point by a bracketed Newton iteration on the Lagrange parameter, for every point of space: inside, outside,
/// at the centre, on axes and symmetry planes, spheres and spheroids. Where several points are closest (the focal disc)
/// one of them is returned: the one at the non-negative end of the smallest axis. Distance accurate to a few units of
/// rounding of max(|p|, largest semi-axis).
SurfacePoint closestOnEllipsoid(const EllipsoidMetric& shape, const Vec3& p);

/// A lower bound of the signed distance, for a point outside; negative inside, where it bounds nothing.
/// f(x) = |x/e| is convex with f = 1 on the surface, so f(p) - 1 <= |grad f(p)| distance; the bound is asymptotically
/// exact near the surface.
inline double ellipsoidDistanceBound_m(const EllipsoidMetric& s, const Vec3& p) {
  const Vec3 a{p.x * s.inverse.x, p.y * s.inverse.y, p.z * s.inverse.z};
  const double f2 = norm2(a);
  if (!(f2 > 1)) return -s.min_axis_m;
  const Vec3 g{p.x * s.inverse2.x, p.y * s.inverse2.y, p.z * s.inverse2.z};
  return (f2 - std::sqrt(f2)) / norm(g);
}

/// First time in [0, 1] at which the straight path p0 -> p1 enters the ellipsoid from outside: the first root of the
/// quadratic |p(t)/e|^2 = 1. A start on the surface (within 1e-10 of it in |p/e|^2) counts as outside where the motion
/// is inward; a start inside, and a path that only grazes, do not enter.
std::optional<double> ellipsoidEntry(const EllipsoidMetric& shape, const Vec3& p0, const Vec3& p1);

}  // namespace gambeson
