#include "core/cloth/draft/cloth_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr const char* kSides[] = {"u0", "u1", "v0", "v1"};

/// 0 to 3; -1 for other names.
int sideOf(const std::string& name) {
  for (int k = 0; k < 4; ++k)
    if (name == kSides[k]) return k;
  return -1;
}

[[noreturn]] void reject(const std::string& key, const std::string& reason) { throw InputError({"", 0, key}, reason); }

bool isFinite(const Vec3& x) { return std::isfinite(x.x + x.y + x.z); }

void checkVertices(const ClothMesh& m) {
  std::vector<char> used(m.vertices.size(), 0);
  for (const auto& t : m.triangles)
    for (int v : t) {
      if (v < 0 || v >= static_cast<int>(m.vertices.size()))
        reject("triangles", "vertex " + std::to_string(v + 1) + " does not exist");
      used[static_cast<std::size_t>(v)] = 1;
    }
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (!isFinite(m.vertices[v])) reject("vertices", "vertex " + std::to_string(v + 1) + " is not finite");
    if (!used[v]) reject("vertices", "no triangle has vertex " + std::to_string(v + 1));
  }
}

void checkTriangles(const ClothMesh& m) {
  if (m.triangles.empty()) reject("triangles", "there are none");
  if (m.patch.size() != m.triangles.size() || (!m.uv.empty() && m.uv.size() != m.triangles.size()))
    reject("triangles", "each needs a patch, and uv at its corners or none has them");
  std::vector<int> count(m.patch_names.size(), 0);
  std::map<std::pair<int, int>, std::size_t> edges;  // directed
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    const auto& [a, b, c] = m.triangles[t];
    const std::string name = "triangle " + std::to_string(t + 1);
    const auto at = [&](int v) { return m.vertices[static_cast<std::size_t>(v)]; };
    const Vec3 ab = at(b) - at(a), ac = at(c) - at(a), bc = at(c) - at(b);
    const double longest2 = std::max({norm2(ab), norm2(ac), norm2(bc)});
    if (a == b || b == c || a == c || !(norm(cross(ab, ac)) > 1e-9 * longest2))
      reject("triangles", name + " has no area");
    if (m.patch[t] < 0 || m.patch[t] >= static_cast<int>(count.size()) || (t > 0 && m.patch[t] < m.patch[t - 1]))
      reject("triangles", name + " is not in the order of the patches");
    ++count[static_cast<std::size_t>(m.patch[t])];
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      const auto [other, is_new] = edges.try_emplace({from, to}, t);
      if (!is_new)
        reject("triangles", name + " and triangle " + std::to_string(other->second + 1) +
                                " run the same way along the edge of vertices " + std::to_string(from + 1) + " and " +
                                std::to_string(to + 1) +
                                ": more than two triangles meet there, or one of them faces the other side");
    }
  }
  for (std::size_t p = 0; p < count.size(); ++p)
    if (count[p] == 0) reject("patches", "\"" + m.patch_names[p] + "\" has no triangles");
}

void checkLines(const ClothMesh& m) {
  std::set<std::array<int, 3>> edges;  // patch, smaller and larger vertex
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const int a = m.triangles[t][static_cast<std::size_t>(k)],
                b = m.triangles[t][static_cast<std::size_t>((k + 1) % 3)];
      edges.insert({m.patch[t], std::min(a, b), std::max(a, b)});
    }
  for (const MeshLine& line : m.lines) {
    if (line.vertices.size() < 2) reject("lines", "\"" + line.name + "\" needs two vertices or more");
    for (std::size_t k = 1; k < line.vertices.size(); ++k) {
      const int a = line.vertices[k - 1], b = line.vertices[k];
      if (!edges.contains({line.patch, std::min(a, b), std::max(a, b)}))
        reject("lines", "\"" + line.name + "\" goes from vertex " + std::to_string(a + 1) + " to vertex " +
                            std::to_string(b + 1) + ", which no edge of its patch joins");
    }
  }
}

}  // namespace

void checkMesh(const ClothMesh& mesh) {
  checkVertices(mesh);
  checkTriangles(mesh);
  checkLines(mesh);
}

std::vector<int> sideOfLine(const ClothMesh& mesh) {
  std::vector<int> next(mesh.patch_names.size(), 4), out;
  for (const MeshLine& line : mesh.lines) {
    const int side = sideOf(line.name);
    out.push_back(side >= 0 ? side : next[static_cast<std::size_t>(line.patch)]++);
  }
  return out;
}

std::vector<NamedEdge> namedEdges(const ClothMesh& mesh) {
  const std::vector<int> sides = sideOfLine(mesh);
  std::vector<NamedEdge> out;
  for (std::size_t k = 0; k < mesh.lines.size(); ++k) {
    if (sideOf(mesh.lines[k].name) >= 0) continue;
    auto at = std::find_if(out.begin(), out.end(), [&](const NamedEdge& e) { return e.name == mesh.lines[k].name; });
    if (at == out.end()) at = out.insert(out.end(), {mesh.lines[k].name, {}});
    at->edges.push_back({mesh.lines[k].patch, static_cast<Side>(sides[k]), false});
  }
  return out;
}

}  // namespace gambeson
