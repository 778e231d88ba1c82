#pragma once
/// Surfaces of the obstacles that deform, as they are at one instant, for ProximityQuery.

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/contact/mesh_surface.hpp"

namespace gambeson {

/// Positions of the vertices of the obstacles that deform, those of one behind those of another in one array: as many
/// as the obstacles' meshes have, for the whole of a run.
class DeformedVertices {
 public:
  DeformedVertices() = default;
  explicit DeformedVertices(std::span<const Obstacle> obstacles);
  /// Of one obstacle alone.
  DeformedVertices(std::vector<Vec3> x) : x_(std::move(x)), first_{0, x_.size()} {}  // NOLINT: it is that

  /// How many obstacles there are; none before it was made for some.
  std::size_t size() const { return first_.size() - 1; }
  bool empty() const { return size() == 0; }
  bool operator==(const DeformedVertices&) const = default;
  /// The vertices of an obstacle; none of one that does not deform.
  std::span<Vec3> operator[](std::size_t obstacle) {
    return std::span(x_).subspan(first_[obstacle], first_[obstacle + 1] - first_[obstacle]);
  }
  std::span<const Vec3> operator[](std::size_t obstacle) const {
    return std::span(x_).subspan(first_[obstacle], first_[obstacle + 1] - first_[obstacle]);
  }

 private:
  std::vector<Vec3> x_;
  std::vector<std::size_t> first_{0};
};

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
