#pragma once
/// Distance queries on a triangle mesh in its own frame: nearest feature, local minima of the distance, first entry.

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/contact/inside_grid.hpp"
#include "core/contact/lazy_tree.hpp"
#include "core/contact/mesh_topology.hpp"
#include "core/contact/obstacle.hpp"
#include "core/contact/surface_view.hpp"

namespace gambeson {

/// Topology and box tree are built once. A mesh that is rigid in its frame needs no refit: the queries come to it in
/// local coordinates, which is its lazy refit. A mesh that deforms calls refit, and its tree follows when a query needs
/// it: with a list of candidates hardly any does.
class MeshSurface {
 public:
  /// Throws InputError: see meshTopology. A surface that is to be refitted gets no look-up of inside and outside, which
  /// would hold for the first positions only: there the nearest point of all tells.
  explicit MeshSurface(const TriangleMesh& mesh, bool deforms = false);

  /// New positions of the same mesh (Zheng 2013, section 3.6.2), in linear time.
  void refit(std::span<const Vec3> vertices);

  const Box& bounds() const { return bounds_; }
  bool closed() const { return topology_.closed; }
  const MeshTopology& topology() const { return topology_; }
  /// Good until the surface is refitted.
  const SurfaceView& view() const { return view_; }
  /// Where each face's vertices stand.
  std::span<const Vec3> positions() const { return x_; }
  /// Lengths below this are rounding: two feet this close (times 100) are one.
  double tolerance_m() const { return view_.tolerance_m; }

  /// The nearest point within `radius` (none: empty). The sign is that of the pseudo-normal of the nearest feature
  /// (angle-weighted at vertices; Baerentzen and Aanaes 2005), exact for closed meshes. Beyond the rim of an open mesh
  /// the distance is positive.
  std::optional<MeshPoint> nearest(const Vec3& p, double radius) const;

  /// What a sample at p touches within `radius`: every local minimum of the distance that faces p, so one on flat and
  /// convex parts and several in concave ones; none at the inner edges of flat or concave parts, because a foot on
  /// an edge or vertex counts only if it is the closest point of every triangle there. A point behind the surface gets
  /// its nearest foot only (the way out), in a closed mesh at any depth. Appended to `out`, sorted by feature. (A point
  /// on a sharp edge to within the tolerance sees the faces of both sides.)
  void touching(const Vec3& p, double radius, std::vector<MeshPoint>& out) const;
  /// The same, where `triangles` are all that come within `radius` of p. `outside`: p is known to be.
  void touching(const Vec3& p, double radius, std::span<const int> triangles, std::vector<MeshPoint>& out,
                bool outside = false) const;

  /// The nearest point, where p may be inside of a closed mesh; empty where it is surely not. `within_m`: some point of
  /// the surface is known to be no farther.
  std::optional<MeshPoint> wayOut(const Vec3& p, double within_m = std::numeric_limits<double>::infinity()) const;

  /// The foot's point as weights of the vertices of its triangle, edge or corner.
  MaterialPoint material(const MeshPoint& foot) const { return view_.material(foot); }

 private:
  void place(std::span<const Vec3> vertices);
  void chooseFeet(const Vec3& p, double radius, bool seen, std::size_t begin, std::vector<MeshPoint>& out) const;

  MeshTopology topology_;
  std::vector<Vec3> x_;                        ///< positions
  std::vector<SurfaceView::Owns> owns_;        ///< of each face
  std::vector<MeshTopology::Corner> corners_;  ///< of vertex v: [corners_begin_[v], corners_begin_[v + 1]), by face
  std::vector<int> corners_begin_;
  std::vector<int> named_;  ///< vertices of triangles
  Box bounds_;
  LazyTree tree_;
  InsideGrid inside_;
  SurfaceView view_;
};

}  // namespace gambeson
