#pragma once
/// Where a body meets level ground.

#include "human/body.hpp"

namespace gambeson {

/// The lowest point of a shape, in its own frame, when it stands with rotation R_WS. Ellipsoid: A² d / |A d| with d =
/// -R_WSᵀ e_z.
Vec3 lowestPoint(const Shape& shape, const Mat3& R_WS);

/// Height of the lowest point of all shapes.
double lowestHeight(const Human& human, std::span<const Pose> link_poses);

}  // namespace gambeson
