#pragma once
/// Surfaces of the obstacles that deform, as they are at one instant, for ProximityQuery.

#include <memory>
#include <span>
#include <vector>

#include "core/contact/mesh_surface.hpp"

namespace gambeson {

/// Positions of the vertices of each obstacle that deforms; empty for the others.
using DeformedVertices = std::vector<std::vector<Vec3>>;

/// Made once for the obstacles (topology, trees), then moved from instant to instant in linear time.
class DeformedSurfaces {
 public:
  DeformedSurfaces() = default;
  explicit DeformedSurfaces(std::span<const Obstacle> obstacles);

  bool empty() const { return surfaces_.empty(); }  ///< no obstacle deforms
  /// The surfaces at `start`; queries about the time from there to `end` (the same for an instant) count on the way
  /// that each body's fastest vertex goes.
  void move(const DeformedVertices& start, const DeformedVertices& end);
  void move(const DeformedVertices& at) { move(at, at); }

  /// The surface of an obstacle, which must be one that deforms.
  const MeshSurface& of(int obstacle) const { return *surfaces_[obstacle]; }
  double motion_m(int obstacle) const { return motion_[obstacle]; }

 private:
  std::vector<std::unique_ptr<MeshSurface>> surfaces_;  ///< of each obstacle; null where it does not deform
  std::vector<double> motion_;
};

}  // namespace gambeson
