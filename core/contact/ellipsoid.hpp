#pragma once
/// Distance between a point and an ellipsoid that is aligned with its frame and centred at the frame's origin.

#include <optional>

#include "core/contact/ellipsoid_foot.hpp"
#include "core/contact/obstacle.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Throws InputError unless every semi-axis is positive and finite.
EllipsoidMetric ellipsoidMetric(const Ellipsoid& shape);

/// First time in [0, 1] at which the straight path p0 -> p1 enters the ellipsoid from outside: the first root of the
/// quadratic |p(t)/e|^2 = 1. A start on the surface (within 1e-10 of it in |p/e|^2) counts as outside where the motion
/// is inward; a start inside, and a path that only grazes, do not enter.
std::optional<double> ellipsoidEntry(const EllipsoidMetric& shape, const Vec3& p0, const Vec3& p1);

}  // namespace gambeson
