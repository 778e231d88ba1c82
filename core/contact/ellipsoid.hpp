#pragma once
/// Distance between a point and an ellipsoid that is aligned with its frame and centred at the frame's origin.

#include "core/contact/ellipsoid_path.hpp"
#include "core/contact/obstacle.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Throws InputError unless every semi-axis is positive and finite.
EllipsoidMetric ellipsoidMetric(const Ellipsoid& shape);

}  // namespace gambeson
