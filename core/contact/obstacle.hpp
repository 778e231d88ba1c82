#pragma once
/// Bodies of infinite mass that cloth touches: shapes, each rigid up to a scale, whose placement the step prescribes,
/// and meshes that deform, whose vertices it prescribes.

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
  /// A mesh whose vertices move one by one (Stage::vertices), in the world: its placement is the identity. `shape`
  /// tells its triangles, and where its vertices are at first.
  bool deforms = false;
};

/// A material point of a mesh that deforms: weights of up to three of its vertices, which add up to 1. Of a body that
/// does not deform: no vertex.
struct MaterialPoint {
  std::array<int, 3> vertex{-1, -1, -1};
  std::array<double, 3> weight{};

  bool given() const { return vertex[0] >= 0; }
  void add(int v, double w) {
    int k = 0;
    while (vertex[k] >= 0) ++k;
    vertex[k] = v;
    weight[k] = w;
  }
  Vec3 of(std::span<const Vec3> x) const {
    Vec3 sum{};
    for (int k = 0; k < 3 && vertex[k] >= 0; ++k) sum += weight[k] * x[vertex[k]];
    return sum;
  }
};

}  // namespace gambeson
