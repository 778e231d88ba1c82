#pragma once
/// Triangles of simple solids, outward-oriented, centred at the origin.

#include "core/contact/obstacle.hpp"

namespace gambeson {

TriangleMesh boxMesh(const Vec3& size);
/// Axis along z; 48 sides, whose chords lie at most 0.22 % of the radius inside the circle.
TriangleMesh cylinderMesh(double radius, double length);

}  // namespace gambeson
