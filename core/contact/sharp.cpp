#include "core/contact/sharp.hpp"

#include <algorithm>

namespace gambeson {

Vec3 alongFrom(const ContactMesh& mesh, std::span<const Vec3> x, int v, int edge) {
  const auto& [a, b] = mesh.edges[edge];
  return normalized(a == v ? x[b] - x[a] : x[a] - x[b]);
}

Vec3 acrossFrom(const ContactMesh& mesh, std::span<const Vec3> x, int edge, int t) {
  const auto& [a, b] = mesh.edges[edge];
  const Vec3 along = x[b] - x[a];
  Vec3 r{};
  for (int c : mesh.triangles[t])
    if (c != a && c != b) r = x[c] - x[a];
  return normalized(r - (dot(r, along) / norm2(along)) * along);
}

/// Half the angle by which two faces bend has half the length of the sum as its sine.
bool isSharpEdge(const ContactMesh& mesh, std::span<const Vec3> x, int edge) {
  const std::span<const int> faces = mesh.edge_faces[edge];
  return faces.size() == 1 || (faces.size() == 2 && norm(acrossFrom(mesh, x, edge, faces[0]) +
                                                         acrossFrom(mesh, x, edge, faces[1])) > 2 * kSharpEdge);
}

bool isSharpCorner(const ContactMesh& mesh, std::span<const Vec3> x, int v) {
  Vec3 sum{};
  for (int e : mesh.vertex_edges[v]) sum += alongFrom(mesh, x, v, e);
  return std::all_of(mesh.vertex_edges[v].begin(), mesh.vertex_edges[v].end(),
                     [&](int e) { return dot(alongFrom(mesh, x, v, e), sum) > kSharpCorner * norm(sum); });
}

}  // namespace gambeson
