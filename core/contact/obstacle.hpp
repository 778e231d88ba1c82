#pragma once
/// Bodies of infinite mass that cloth touches: shapes, each rigid up to a scale, whose placement the step prescribes.

#include <array>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// Centred at its frame's origin, semi-axes along x, y, z [m].
struct Ellipsoid {
  Vec3 semi_axes;
};

/// Outward-oriented triangles; closed or open (the back of an open mesh is not seen beyond the reach of a query).
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;
};

using Shape = std::variant<Ellipsoid, TriangleMesh>;

/// One obstacle: a shape and the name of the body segment it belongs to.
struct Obstacle {
  Shape shape;
  std::string segment;
};

}  // namespace gambeson
