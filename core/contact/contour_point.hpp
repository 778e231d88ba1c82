#pragma once
/// Where an edge passes through a triangle, in floating point.

#include <array>
#include <span>

#include "core/contact/contour.hpp"

namespace gambeson {

/// x, edge_weight and triangle_weight of a crossing.
ContourPoint crossingPoint(const ContactMesh& mesh, std::span<const Vec3> x, int edge, int triangle);

}  // namespace gambeson
