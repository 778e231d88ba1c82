#pragma once
/// What is constant about cloth and bodies, on a device.

#include <memory>
#include <span>
#include <vector>

#include "core/cloth/bulge_view.hpp"
#include "core/contact/cloth_pair.hpp"
#include "core/contact/ellipsoid.hpp"
#include "core/contact/mesh_surface.hpp"
#include "core/motion/body_edge_pair.hpp"
#include "gpu/finding/flat_mesh.hpp"
#include "gpu/near/near_search.hpp"
#include "gpu/near/uploaded.hpp"

namespace gambeson::gpu {

/// Lists of numbers (core's Lists).
template <class Device>
struct FlatLists {
  FlatLists(typename Device::Queue& queue, const Lists& lists)
      : first(uploaded<Device>(queue, lists.first)), items(uploaded<Device>(queue, lists.items)) {}
  ListsView view() const { return {first.data(), items.data()}; }

  typename Device::template Buffer<int> first, items;
};

template <class Device>
struct FlatRows {
  FlatRows(typename Device::Queue& queue, const SparseRows& rows)
      : offsets(uploaded<Device>(queue, rows.offsets)),
        columns(uploaded<Device>(queue, rows.columns)),
        values(uploaded<Device>(queue, rows.values)) {}
  RowsView view() const { return {offsets.data(), columns.data(), values.data()}; }

  typename Device::template Buffer<int> offsets, columns;
  typename Device::template Buffer<double> values;
};

/// The topology of an obstacle that is a mesh.
template <class Device>
class FlatSurface {
 public:
  template <class T>
  using Buffer = typename Device::template Buffer<T>;

  FlatSurface(typename Device::Queue& queue, const TriangleMesh& mesh) {
    const MeshSurface surface(mesh, true);
    const MeshTopology& m = surface.topology();
    const SurfaceView& v = surface.view();
    const auto copy = [&](auto& to, const auto* from, std::size_t n) {
      to = uploaded<Device>(queue, std::span(from, n));
    };
    const std::size_t vertices = mesh.vertices.size(), faces = m.triangles.size(), edges = m.edges.size();
    triangles_ = uploaded<Device>(queue, m.triangles);
    face_edges_ = uploaded<Device>(queue, m.face_edges);
    edges_ = uploaded<Device>(queue, m.edges);
    edge_begin_ = uploaded<Device>(queue, m.edge_begin);
    edge_faces_ = uploaded<Device>(queue, m.edge_faces);
    vertex_begin_ = uploaded<Device>(queue, m.vertex_begin);
    vertex_edges_ = uploaded<Device>(queue, m.vertex_edges);
    rim_edge_ = uploaded<Device>(queue, m.rim_edge);
    rim_vertex_ = uploaded<Device>(queue, m.rim_vertex);
    copy(corners_begin_, v.corners_begin, vertices + 1);
    copy(corners_, v.corners, static_cast<std::size_t>(v.corners_begin[vertices]));
    copy(owns_, v.owns, faces);
    local_ = uploaded<Device>(queue, mesh.vertices);
    std::vector<char> is_named(vertices, 0);
    for (const auto& t : m.triangles)
      for (int c : t) is_named[c] = 1;
    std::vector<int> named;
    for (std::size_t i = 0; i < vertices; ++i)
      if (is_named[i]) named.push_back(static_cast<int>(i));
    named_ = uploaded<Device>(queue, named);
    view_ = {nullptr,
             v.tolerance_m,
             static_cast<int>(faces),
             static_cast<int>(edges),
             triangles_.data(),
             face_edges_.data(),
             edges_.data(),
             edge_begin_.data(),
             edge_faces_.data(),
             vertex_begin_.data(),
             vertex_edges_.data(),
             corners_begin_.data(),
             corners_.data(),
             rim_edge_.data(),
             rim_vertex_.data(),
             owns_.data(),
             m.closed};
    bounds_ = surface.bounds();
  }

  /// Positions are to be set.
  const SurfaceView& view() const { return view_; }
  const Box& bounds() const { return bounds_; }  ///< in the mesh's frame, at first
  const Buffer<int>& named() const { return named_; }
  const Buffer<Vec3>& local() const { return local_; }

 private:
  Buffer<std::array<int, 3>> triangles_, face_edges_;
  Buffer<MeshTopology::Edge> edges_;
  Buffer<int> edge_begin_, vertex_begin_, vertex_edges_, corners_begin_, named_;
  Buffer<MeshTopology::Corner> edge_faces_, corners_;
  Buffer<char> rim_edge_, rim_vertex_;
  Buffer<SurfaceView::Owns> owns_;
  Buffer<Vec3> local_;
  SurfaceView view_;
  Box bounds_;
};

/// A body of triangles in a step. What is constant is written once, the rest by the kernels that begin a pass.
struct BodySurface {
  SurfaceView view;
  Box local;   ///< bounds in the frame of a rigid mesh
  Box bounds;  ///< of the vertices of faces in the frame that feet are sought in
  double motion_m = 0;
  Placement start, end;
  int obstacle = 0, first_vertex = 0, vertices = 0;
  bool deforms = false;
  const int* named = nullptr;  ///< vertices of faces
  int named_count = 0;
  const Vec3* at = nullptr;  ///< of a rigid mesh, in its frame
};

struct EllipsoidBody {
  EllipsoidMetric metric;
  double motion_m = 0;
  Placement start, end;
  int obstacle = 0;
};

/// Vertices of the cloth and of bodies, as CollisionModel numbers them.
template <class Device>
struct DressedMesh {
  template <class T>
  using Buffer = typename Device::template Buffer<T>;
  using Queue = typename Device::Queue;

  DressedMesh(Queue& queue, const NearModel& model, std::span<const Vec3> x0);

  ContactMeshView mesh() const {
    return {vertices,          triangle_count,    edge_count,          triangles.data(),   edges.data(),
            face_edges.data(), edge_faces.view(), vertex_faces.view(), vertex_edges.view()};
  }
  ClothPairs clothPairs() const {
    return {mesh(), {samples, rest.data(), garment.data(), thickness.data()}, x0.data(), x1.data()};
  }
  BodyEdgeView bodyEdges() const {
    BodyEdgeView view;
    view.mesh = mesh();
    view.sharp_edge = sharp_edge.data(), view.sharp_corner = sharp_corner.data();
    view.body_of_vertex = body_of_vertex.data(), view.deforms = deforms.data();
    view.thickness_m = thickness.data(), view.largest_thickness_m = largest_thickness_m;
    view.x0 = x0.data(), view.x1 = x1.data();
    return view;
  }
  BulgesView bulges() const { return {middle.view(), of_sample.view(), ends.data()}; }

  int samples, vertices, triangle_count, edge_count, cloth_triangles, cloth_edges;
  double largest_thickness_m;
  Buffer<std::array<int, 3>> triangles, face_edges;
  Buffer<std::array<int, 2>> edges, ends;
  FlatLists<Device> edge_faces, vertex_faces, vertex_edges;
  FlatRows<Device> middle, of_sample;  ///< Bulges
  Buffer<Vec3> rest;
  Buffer<int> garment, body_of_vertex;
  Buffer<int> body_triangle;  ///< of each triangle of bodies, its number in its mesh
  Buffer<double> thickness;
  Buffer<float> half_reach;  ///< of each vertex; of bodies -1
  Buffer<char> sharp_edge, sharp_corner, deforms;
  // Of trees and queries.
  MortonCube cube;
  Buffer<int> cloth_face, body_face, cloth_edge;  ///< corners, as FlatMesh has them
  Buffer<int> samples_along, corners_along;       ///< samples, and sharp corners of bodies, near ones after each other
  Buffer<int> body_edges_along;                   ///< likewise sharp edges of bodies
  int body_faces = 0, corner_count = 0, body_edge_count = 0;
  // Of a step.
  Buffer<Vec3> x0, x1;
};

/// Numbers i < n with keep(i), sorted along the curve by where they are.
template <class Keep, class At>
std::vector<int> alongCurve(const MortonCube& cube, int n, const Keep& keep, const At& at) {
  std::vector<std::pair<std::uint32_t, int>> place;
  for (int i = 0; i < n; ++i)
    if (keep(i)) place.emplace_back(cube.code(boxOf({at(i), at(i)}, 0)), i);
  std::ranges::sort(place);
  std::vector<int> order;
  for (const auto& [code, i] : place) order.push_back(i);
  return order;
}

template <class Device>
DressedMesh<Device>::DressedMesh(Queue& queue, const NearModel& model, std::span<const Vec3> start)
    : samples(model.collisions.cloth.cloth_vertices),
      vertices(model.collisions.mesh.vertex_count),
      triangle_count(static_cast<int>(model.collisions.mesh.triangles.size())),
      edge_count(static_cast<int>(model.collisions.mesh.edges.size())),
      cloth_triangles(model.collisions.cloth_triangles),
      largest_thickness_m(model.collisions.largest_thickness_m),
      triangles(uploaded<Device>(queue, model.collisions.mesh.triangles)),
      face_edges(uploaded<Device>(queue, model.collisions.mesh.face_edges)),
      edges(uploaded<Device>(queue, model.collisions.mesh.edges)),
      ends(uploaded<Device>(queue, model.bulges.ends)),
      edge_faces(queue, model.collisions.mesh.edge_faces),
      vertex_faces(queue, model.collisions.mesh.vertex_faces),
      vertex_edges(queue, model.collisions.mesh.vertex_edges),
      middle(queue, model.bulges.middle),
      of_sample(queue, model.bulges.of_sample),
      rest(uploaded<Device>(queue, model.collisions.cloth.rest)),
      garment(uploaded<Device>(queue, model.collisions.cloth.garment)),
      body_of_vertex(uploaded<Device>(queue, model.collisions.body_of_vertex)),
      body_triangle(uploaded<Device>(queue, model.collisions.body_triangle)),
      thickness(uploaded<Device>(queue, model.collisions.cloth.thickness_m)),
      half_reach(uploaded<Device>(queue, model.collisions.vertex_half_reach_m)),
      sharp_edge(uploaded<Device>(queue, model.collisions.sharp_edge)),
      sharp_corner(uploaded<Device>(queue, model.collisions.sharp_corner)),
      cube(cubeAround(start)),
      x0(start.size()),
      x1(start.size()) {
  const CollisionModel& m = model.collisions;
  std::vector<char> deforming;
  for (const CollisionModel::Body& b : m.bodies) deforming.push_back(b.deforms);
  deforms = uploaded<Device>(queue, deforming);
  const auto flat = [&](const auto& primitives, std::size_t from, std::size_t to) {
    std::vector<int> corners;
    for (std::size_t i = from; i < to; ++i) corners.insert(corners.end(), primitives[i].begin(), primitives[i].end());
    return uploaded<Device>(queue, corners);
  };
  // Edges are sorted by their first vertex, and samples come first.
  cloth_edges = 0;
  while (cloth_edges < edge_count && m.mesh.edges[static_cast<std::size_t>(cloth_edges)][0] < samples) ++cloth_edges;
  cloth_face = flat(m.mesh.triangles, 0, static_cast<std::size_t>(cloth_triangles));
  body_face = flat(m.mesh.triangles, static_cast<std::size_t>(cloth_triangles), m.mesh.triangles.size());
  cloth_edge = flat(m.mesh.edges, 0, static_cast<std::size_t>(cloth_edges));
  body_faces = triangle_count - cloth_triangles;
  const auto at = [&](int v) { return start[static_cast<std::size_t>(v)]; };
  const auto is = [](const std::vector<char>& flags, int i) { return flags[static_cast<std::size_t>(i)] != 0; };
  samples_along = uploaded<Device>(queue, alongCurve(
                                              cube, samples, [](int) { return true; }, at));
  const std::vector<int> corners = alongCurve(
      cube, vertices, [&](int v) { return v >= samples && is(m.sharp_corner, v); }, at);
  const std::vector<int> body_edges = alongCurve(
      cube, edge_count, [&](int e) { return e >= cloth_edges && is(m.sharp_edge, e); },
      [&](int e) { return at(m.mesh.edges[static_cast<std::size_t>(e)][0]); });
  corner_count = static_cast<int>(corners.size());
  body_edge_count = static_cast<int>(body_edges.size());
  corners_along = uploaded<Device>(queue, corners);
  body_edges_along = uploaded<Device>(queue, body_edges);
}

}  // namespace gambeson::gpu
