#pragma once
/// From an implicit function that is symmetric in y to a well-shaped triangle mesh.

#include <functional>

#include "core/contact/obstacle.hpp"

namespace gambeson {

struct ImplicitSurface {
  std::function<double(const Vec3&)> value;  ///< negative inside
  std::function<Vec3(const Vec3&)> gradient;
  std::function<double(const Vec3&)> edge;  ///< wanted edge length [m]
  Vec3 low, high;                           ///< a box around it
};

/// Marching tetrahedra on a grid of `cell_m` over the half y >= 0, then remeshing towards edges of the wanted length
/// and points on the surface; mirrored. Closed, outward, symmetric to the bit, deterministic.
TriangleMesh meshOf(const ImplicitSurface& surface, double cell_m);

}  // namespace gambeson
