#include "core/contact/mesh_topology.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <tuple>

#include "core/error.hpp"

namespace gambeson {

namespace {

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

std::string place(const Vec3& x) {
  std::ostringstream text;
  text << "(" << x.x << ", " << x.y << ", " << x.z << ") m";
  return text.str();
}

std::vector<int> weld(const std::vector<Vec3>& vertices) {
  std::vector<int> order(vertices.size()), representative(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int i) { return std::make_tuple(vertices[i].x, vertices[i].y, vertices[i].z, i); };
  std::sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  for (std::size_t k = 0; k < order.size(); ++k)
    representative[order[k]] =
        k > 0 && vertices[order[k]] == vertices[order[k - 1]] ? representative[order[k - 1]] : order[k];
  return representative;
}

}  // namespace

std::string meshDefects(const MeshTopology& m) {
  std::vector<int> parent(m.rim_vertex.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  int rim = 0, crowded = 0;
  for (std::size_t e = 0; e < m.edges.size(); ++e) {
    crowded += m.edge_begin[e + 1] - m.edge_begin[e] > 2;
    if (!m.rim_edge[e]) continue;
    ++rim;
    parent[find(m.edges[e].v)] = find(m.edges[e].w);
  }
  int holes = 0;
  for (std::size_t v = 0; v < parent.size(); ++v)
    holes += m.rim_vertex[v] && find(static_cast<int>(v)) == static_cast<int>(v);
  std::string text;
  if (holes > 0)
    text = "is open: " + std::to_string(holes) + (holes == 1 ? " border of " : " borders of ") + std::to_string(rim) +
           " edges together; cloth can pass in and out there, and cloth that starts inside is not pushed out from any "
           "depth";
  if (crowded > 0)
    text += std::string(text.empty() ? "has " : "; it has ") + std::to_string(crowded) +
            (crowded == 1 ? " edge" : " edges") +
            " of more than two triangles: which side of these is outside is not known, and cloth may be taken for "
            "inside there";
  return text;
}

MeshTopology meshTopology(const TriangleMesh& mesh) {
  const int n_vertices = static_cast<int>(mesh.vertices.size()), n_faces = static_cast<int>(mesh.triangles.size());
  if (n_faces == 0) reject("mesh", "has no triangles");
  for (int i = 0; i < n_vertices; ++i)
    for (int c = 0; c < 3; ++c)
      if (!std::isfinite(mesh.vertices[i][c])) reject("mesh", "vertex " + std::to_string(i) + " is not finite");
  for (int t = 0; t < n_faces; ++t)
    for (int i : mesh.triangles[t])
      if (i < 0 || i >= n_vertices)
        reject("mesh", "triangle " + std::to_string(t) + " names vertex " + std::to_string(i) + ", must be 0 to " +
                           std::to_string(n_vertices - 1));

  MeshTopology m;
  m.vertex_of = weld(mesh.vertices);
  m.triangles.resize(n_faces);
  m.face_edges.assign(n_faces, {-1, -1, -1});
  struct Half {
    int v, w, face, k;
    bool forward;
  };
  std::vector<Half> halves;
  for (int t = 0; t < n_faces; ++t) {
    auto& c = m.triangles[t];
    for (int k = 0; k < 3; ++k) c[k] = m.vertex_of[mesh.triangles[t][k]];
    if (c[0] == c[1] || c[1] == c[2] || c[2] == c[0]) continue;
    for (int k = 0; k < 3; ++k) {
      const int a = c[k], b = c[(k + 1) % 3];
      halves.push_back({std::min(a, b), std::max(a, b), t, k, a < b});
    }
  }
  if (halves.empty()) reject("mesh", "all triangles are collapsed");
  std::sort(halves.begin(), halves.end(), [](const Half& a, const Half& b) {
    return std::tie(a.v, a.w, a.face, a.k) < std::tie(b.v, b.w, b.face, b.k);
  });
  m.rim_vertex.assign(n_vertices, 0);
  m.closed = true;
  m.edge_begin.push_back(0);
  for (std::size_t i = 0; i < halves.size();) {
    const int e = static_cast<int>(m.edges.size()), v = halves[i].v, w = halves[i].w;
    m.edges.push_back({v, w});
    int forward = 0, backward = 0;
    for (; i < halves.size() && halves[i].v == v && halves[i].w == w; ++i) {
      ++(halves[i].forward ? forward : backward);
      m.edge_faces.push_back({halves[i].face, halves[i].k});
      m.face_edges[halves[i].face][halves[i].k] = e;
    }
    m.edge_begin.push_back(static_cast<int>(m.edge_faces.size()));
    if (forward + backward == 2 && forward != 1)
      reject("mesh", "triangles " + std::to_string(m.edge_faces[m.edge_begin[e]].face) + " and " +
                         std::to_string(m.edge_faces[m.edge_begin[e] + 1].face) +
                         " disagree on which side is outside, at the edge from " + place(mesh.vertices[v]) + " to " +
                         place(mesh.vertices[w]) + "; turn one of them (most mesh tools recalculate normals)");
    m.rim_edge.push_back(forward + backward == 1);
    if (forward != backward) m.closed = false;
    if (forward + backward == 1) m.rim_vertex[v] = m.rim_vertex[w] = 1;
  }
  m.vertex_begin.assign(n_vertices + 1, 0);
  for (const auto& e : m.edges) ++m.vertex_begin[e.v + 1], ++m.vertex_begin[e.w + 1];
  std::partial_sum(m.vertex_begin.begin(), m.vertex_begin.end(), m.vertex_begin.begin());
  m.vertex_edges.resize(m.vertex_begin.back());
  std::vector<int> cursor(m.vertex_begin.begin(), m.vertex_begin.end() - 1);
  for (std::size_t e = 0; e < m.edges.size(); ++e) {
    m.vertex_edges[cursor[m.edges[e].v]++] = static_cast<int>(e);
    m.vertex_edges[cursor[m.edges[e].w]++] = static_cast<int>(e);
  }
  if (m.closed) {
    double volume6 = 0;
    const Vec3 o = mesh.vertices[m.triangles[0][0]];
    for (const auto& c : m.triangles)
      volume6 += dot(mesh.vertices[c[0]] - o, cross(mesh.vertices[c[1]] - o, mesh.vertices[c[2]] - o));
    if (volume6 < 0) reject("mesh", "is closed and its triangles face inward");
  }
  return m;
}

}  // namespace gambeson
