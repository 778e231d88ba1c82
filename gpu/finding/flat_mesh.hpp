#pragma once
/// The mesh of which pairs are sought, as arrays.

#include <array>
#include <span>
#include <vector>

#include "gpu/finding/float_point.hpp"
#include "gpu/finding/morton.hpp"

namespace gambeson::gpu {

struct Mesh {
  int vertices = 0;
  std::vector<std::array<int, 3>> faces;
  std::vector<std::array<int, 2>> edges;
  /// Vertices from this one on are of bodies, which do not meet each other: faces and edges of cloth come first, and
  /// none has vertices of both. -1: there are no bodies.
  int bodies_from = -1;
};

/// On a device; `point` is filled anew for each step.
template <class Device>
struct FlatMesh {
  template <class T>
  using Buffer = typename Device::template Buffer<T>;

  /// The cube and the order of the vertices are those of these positions: later ones are found as surely.
  FlatMesh(const Mesh& mesh, std::span<const Vec3> x);

  int vertices, faces, edges;
  int cloth_vertices, cloth_faces, cloth_edges;  ///< the first of these; all, where there are no bodies
  Buffer<int> face;                              ///< 3 vertices each
  Buffer<int> edge;                              ///< 2 vertices each
  Buffer<int> body_face;                         ///< those of bodies
  Buffer<int> along_curve;                       ///< vertices near each other after each other
  Buffer<MovingPoint> point;
  Buffer<FloatPoint> rough;  ///< the same, from the start of a pass on
  MortonCube cube;
};

/// Around all positions, a little larger.
inline MortonCube cubeAround(std::span<const Vec3> x) {
  Vec3 lo{INFINITY, INFINITY, INFINITY}, hi = -lo;
  for (const Vec3& p : x)
    for (int k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], p[k]);
      hi[k] = std::max(hi[k], p[k]);
    }
  const double side = std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
  const auto f = [](double v) { return static_cast<float>(v); };
  return {{f(lo.x), f(lo.y), f(lo.z)}, side > 0 ? f(255 / side) : 1.0f};
}

template <class Device>
FlatMesh<Device>::FlatMesh(const Mesh& mesh, std::span<const Vec3> x)
    : vertices(mesh.vertices),
      faces(static_cast<int>(mesh.faces.size())),
      edges(static_cast<int>(mesh.edges.size())),
      cloth_vertices(mesh.bodies_from < 0 ? mesh.vertices : mesh.bodies_from),
      cloth_faces(
          static_cast<int>(std::ranges::count_if(mesh.faces, [&](const auto& f) { return f[0] < cloth_vertices; }))),
      cloth_edges(
          static_cast<int>(std::ranges::count_if(mesh.edges, [&](const auto& e) { return e[0] < cloth_vertices; }))),
      face(3 * mesh.faces.size()),
      edge(2 * mesh.edges.size()),
      along_curve(x.size()),
      point(x.size()),
      rough(x.size()),
      cube(cubeAround(x)) {
  std::vector<std::pair<std::uint32_t, int>> place;
  for (int i = 0; i < vertices; ++i) place.emplace_back(cube.code(boxOf({x[i], x[i]}, 0)), i);
  std::ranges::sort(place);
  std::vector<int> order, corners;
  for (const auto& [code, i] : place) order.push_back(i);
  typename Device::Queue queue;
  queue.upload(std::span<const int>(order), along_curve);
  for (const auto& f : mesh.faces) corners.insert(corners.end(), f.begin(), f.end());
  queue.upload(std::span<const int>(corners), face);
  const auto of_bodies = std::span<const int>(corners).subspan(3 * static_cast<std::size_t>(cloth_faces));
  body_face = Buffer<int>(of_bodies.size());
  if (!of_bodies.empty()) queue.upload(of_bodies, body_face);
  corners.clear();
  for (const auto& e : mesh.edges) corners.insert(corners.end(), e.begin(), e.end());
  queue.upload(std::span<const int>(corners), edge);
}

}  // namespace gambeson::gpu
