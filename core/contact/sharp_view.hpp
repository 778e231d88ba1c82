#pragma once
/// Sharp edges and corners (sharp.hpp), for host and device.

#include "core/contact/contact_mesh_view.hpp"

namespace gambeson {

constexpr double kSharpEdge = 0.26;  ///< sine of 15 degrees: half the angle by which two faces bend
constexpr double kSharpCorner = 0.26;

/// Unit vector from vertex v along an edge that ends there.
GAMBESON_HD inline Vec3 alongFrom(const ContactMeshView& mesh, const Vec3* x, int v, int edge) {
  const auto& [a, b] = mesh.edges[edge];
  return normalized(a == v ? x[b] - x[a] : x[a] - x[b]);
}

/// Unit vector in the plane of triangle t, from its edge into it.
GAMBESON_HD inline Vec3 acrossFrom(const ContactMeshView& mesh, const Vec3* x, int edge, int t) {
  const auto& [a, b] = mesh.edges[edge];
  const Vec3 along = x[b] - x[a];
  Vec3 r{};
  for (int c : mesh.triangles[t])
    if (c != a && c != b) r = x[c] - x[a];
  return normalized(r - (dot(r, along) / norm2(along)) * along);
}

/// Half the angle by which two faces bend has half the length of the sum as its sine.
GAMBESON_HD inline bool isSharpEdge(const ContactMeshView& mesh, const Vec3* x, int edge) {
  const std::span<const int> faces = mesh.edge_faces[edge];
  return faces.size() == 1 || (faces.size() == 2 && norm(acrossFrom(mesh, x, edge, faces[0]) +
                                                         acrossFrom(mesh, x, edge, faces[1])) > 2 * kSharpEdge);
}

GAMBESON_HD inline bool isSharpCorner(const ContactMeshView& mesh, const Vec3* x, int v) {
  Vec3 sum{};
  for (int e : mesh.vertex_edges[v]) sum += alongFrom(mesh, x, v, e);
  for (int e : mesh.vertex_edges[v])
    if (!(dot(alongFrom(mesh, x, v, e), sum) > kSharpCorner * norm(sum))) return false;
  return true;
}

}  // namespace gambeson
