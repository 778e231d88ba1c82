#include "core/contact/contact_mesh.hpp"

#include <algorithm>
#include <cassert>

namespace gambeson {
namespace {

/// List i holds all k, ascending, for which some owners(k) is i.
template <class Owners>
Lists invert(int lists, int count, Owners&& owners) {
  Lists out;
  out.first.assign(lists + 1, 0);
  for (int k = 0; k < count; ++k)
    for (int i : owners(k)) ++out.first[i + 1];
  for (int i = 0; i < lists; ++i) out.first[i + 1] += out.first[i];
  out.items.resize(out.first[lists]);
  std::vector<int> next(out.first.begin(), out.first.end() - 1);
  for (int k = 0; k < count; ++k)
    for (int i : owners(k)) out.items[next[i]++] = k;
  return out;
}

}  // namespace

ContactMesh contactMesh(int vertex_count, std::span<const std::array<int, 3>> triangles,
                        std::span<const std::array<int, 2>> twins) {
  ContactMesh m;
  m.vertex_count = vertex_count;
  m.triangles.assign(triangles.begin(), triangles.end());
  const int faces = static_cast<int>(triangles.size());
  const auto edgeOf = [&](int t, int k) {
    const auto [v, w] = std::minmax(triangles[t][k], triangles[t][(k + 1) % 3]);
    assert(0 <= v && v < w && w < vertex_count);
    return std::array<int, 2>{v, w};
  };
  for (int t = 0; t < faces; ++t)
    for (int k = 0; k < 3; ++k) m.edges.push_back(edgeOf(t, k));
  std::sort(m.edges.begin(), m.edges.end());
  m.edges.erase(std::unique(m.edges.begin(), m.edges.end()), m.edges.end());
  m.face_edges.resize(faces);
  for (int t = 0; t < faces; ++t)
    for (int k = 0; k < 3; ++k)
      m.face_edges[t][k] =
          static_cast<int>(std::lower_bound(m.edges.begin(), m.edges.end(), edgeOf(t, k)) - m.edges.begin());
  const int edges = static_cast<int>(m.edges.size());
  m.edge_faces = invert(edges, faces, [&](int t) { return m.face_edges[t]; });
  m.vertex_faces = invert(vertex_count, faces, [&](int t) { return m.triangles[t]; });
  m.vertex_edges = invert(vertex_count, edges, [&](int e) { return m.edges[e]; });
  if (twins.empty()) return m;
  std::vector<std::vector<int>> of_vertex(static_cast<std::size_t>(vertex_count));
  for (const auto& [v, w] : twins) {
    assert(v != w && 0 <= std::min(v, w) && std::max(v, w) < vertex_count);
    of_vertex[static_cast<std::size_t>(v)].push_back(w);
    of_vertex[static_cast<std::size_t>(w)].push_back(v);
  }
  for (std::vector<int>& list : of_vertex) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    m.twins.add(list);
  }
  return m;
}

}  // namespace gambeson
