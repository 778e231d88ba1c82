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

/// True only if p is outside and further than `limit_m` >= 0 from the ellipsoid: a cheap and certain reject, sharp near
/// the surface. f(x) = |x/e|^2 is convex with f = 1 on the surface, so f(p) - 1 <= |grad f(p)| distance.
inline bool surelyBeyond(const EllipsoidMetric& s, const Vec3& p, double limit_m) {
  const Vec3 a{p.x * s.inverse.x, p.y * s.inverse.y, p.z * s.inverse.z};
  const Vec3 g{a.x * s.inverse.x, a.y * s.inverse.y, a.z * s.inverse.z};
  const double excess = norm2(a) - 1;
  constexpr double slack = 1e-12;  // of rounding
  return excess > slack && (excess - slack) * (excess - slack) > 4 * (1 + slack) * limit_m * limit_m * norm2(g);
}

/// First time in [0, 1] at which the straight path p0 -> p1 enters the ellipsoid from outside: the first root of the
/// quadratic |p(t)/e|^2 = 1. A start on the surface (within 1e-10 of it in |p/e|^2) counts as outside where the motion
/// is inward; a start inside, and a path that only grazes, do not enter.
std::optional<double> ellipsoidEntry(const EllipsoidMetric& shape, const Vec3& p0, const Vec3& p1);

}  // namespace gambeson
