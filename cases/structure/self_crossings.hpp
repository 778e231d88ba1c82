#pragma once
/// Where a sampled surface passes through itself: a count for tables, in floating point. Not a certified detection:
/// what only touches, or overlaps in one plane, is not counted.

#include <array>
#include <span>

#include "core/math/vec.hpp"

namespace gambeson {

/// Pairs of triangles one of which has an edge that passes through the inside of the other. Pairs that share a vertex,
/// or have vertices at one place (a seam), are neighbours and not counted.
long selfCrossings(std::span<const Vec3> points, std::span<const std::array<int, 3>> triangles);

}  // namespace gambeson
