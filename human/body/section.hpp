#pragma once
/// Horizontal sections of bodies, and their girth by the tape.

#include <vector>

#include "core/contact/obstacle.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// The points where a placed shape meets the plane z = height: 720 points of an ellipse, or the crossings of a mesh's
/// edges. Empty where they do not meet.
std::vector<Vec2> crossSection(const Shape& shape, const Placement& placement, double height);

/// The convex hull, counterclockwise, without points on its edges (Andrew's monotone chain).
std::vector<Vec2> convexHull(std::vector<Vec2> points);

/// What a tape around these points measures [m]: the length of their convex hull, 0 of fewer than two.
double tapeGirth(std::vector<Vec2> points);

}  // namespace gambeson
