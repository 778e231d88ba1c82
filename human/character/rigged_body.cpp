/// Detail of rigged_mesh.hpp: the body alone, fit to be a skin.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/error.hpp"
#include "human/character/rigged_mesh.hpp"

namespace gambeson {
namespace {

constexpr double kWeld = 5e-6;

using Cube = std::array<long, 3>;

/// The first vertex within `weld` of each, itself where there is none before it.
std::vector<int> weldedTo(const std::vector<Vec3>& x, double weld) {
  std::map<Cube, std::vector<int>> grid;
  std::vector<int> to(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) {
    Cube c{};
    for (int k = 0; k < 3; ++k) c[static_cast<std::size_t>(k)] = std::lround(std::floor(x[v][k] / weld));
    int found = -1;
    for (long i = -1; i <= 1; ++i)
      for (long j = -1; j <= 1; ++j)
        for (long k = -1; k <= 1; ++k)
          if (const auto at = grid.find({c[0] + i, c[1] + j, c[2] + k}); at != grid.end())
            for (const int w : at->second)
              if (norm(x[static_cast<std::size_t>(w)] - x[v]) <= weld && (found < 0 || w < found)) found = w;
    to[v] = found < 0 ? static_cast<int>(v) : found;
    if (found < 0) grid[c].push_back(static_cast<int>(v));
  }
  return to;
}

/// Which part that hangs together each vertex belongs to: its smallest vertex.
std::vector<int> partsOf(const TriangleMesh& m) {
  std::vector<int> root(m.vertices.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const auto& t : m.triangles)
    for (int k = 1; k < 3; ++k) {
      const int a = find(t[0]), b = find(t[k]);
      root[std::max(a, b)] = std::min(a, b);
    }
  for (std::size_t v = 0; v < root.size(); ++v) root[v] = find(static_cast<int>(v));
  return root;
}

double volumeOf(const TriangleMesh& m, const std::array<int, 3>& t, const Vec3& about) {
  return dot(m.vertices[t[0]] - about, cross(m.vertices[t[1]] - about, m.vertices[t[2]] - about)) / 6;
}

/// Edges that do not stand once either way.
std::size_t openEdges(const TriangleMesh& m) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : m.triangles)
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : 1024;
    }
  return static_cast<std::size_t>(
      std::count_if(edges.begin(), edges.end(), [](const auto& e) { return e.second != 1025; }));
}

}  // namespace

RiggedMesh bodyOf(const RiggedMesh& whole) {
  const auto fail = [&](const std::string& key, const std::string& reason) {
    throw InputError({whole.file, 0, key}, reason);
  };
  Vec3 low = whole.mesh.vertices.front(), high = low;
  for (const Vec3& x : whole.mesh.vertices)
    for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
  const double weld = kWeld * norm(high - low);
  if (!(weld > 0)) fail("", "all its vertices are at one place");
  RiggedMesh joined = whole;
  const std::vector<int> to = weldedTo(whole.mesh.vertices, weld);
  joined.mesh.triangles.clear();
  for (auto t : whole.mesh.triangles) {
    for (int& v : t) v = to[static_cast<std::size_t>(v)];
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) joined.mesh.triangles.push_back(t);
  }
  if (joined.mesh.triangles.empty()) fail("", "holds no triangle with an area");

  const std::vector<int> part = partsOf(joined.mesh);
  std::map<int, double> volume;
  std::map<int, int> triangles;
  for (const auto& t : joined.mesh.triangles) {
    const int p = part[static_cast<std::size_t>(t[0])];
    volume[p] += volumeOf(joined.mesh, t, joined.mesh.vertices[static_cast<std::size_t>(p)]);
    ++triangles[p];
  }
  const int body = std::max_element(volume.begin(), volume.end(), [](const auto& a, const auto& b) {
                     return std::abs(a.second) < std::abs(b.second);
                   })->first;

  RiggedMesh out;
  out.file = whole.file, out.unit_m = whole.unit_m, out.bones = whole.bones, out.notes = whole.notes;
  std::vector<int> number(joined.mesh.vertices.size(), -1);
  std::vector<std::vector<int>> sources;
  for (const auto& t : joined.mesh.triangles) {
    if (part[static_cast<std::size_t>(t[0])] != body) continue;
    std::array<int, 3> mine{};
    for (int k = 0; k < 3; ++k) {
      int& n = number[static_cast<std::size_t>(t[k])];
      if (n < 0) {
        n = static_cast<int>(out.mesh.vertices.size());
        out.mesh.vertices.push_back(joined.mesh.vertices[static_cast<std::size_t>(t[k])]);
      }
      mine[static_cast<std::size_t>(k)] = n;
    }
    if (volume[body] < 0) std::swap(mine[1], mine[2]);
    out.mesh.triangles.push_back(mine);
  }
  sources.resize(out.mesh.vertices.size());
  std::size_t used = 0, kept = 0;
  std::vector<char> in_use(whole.mesh.vertices.size(), 0);
  for (const auto& t : whole.mesh.triangles)
    for (const int v : t) in_use[static_cast<std::size_t>(v)] = 1;
  for (std::size_t v = 0; v < to.size(); ++v) {
    if (!in_use[v]) continue;
    ++used;
    const int n = number[static_cast<std::size_t>(to[v])];
    if (n >= 0) sources[static_cast<std::size_t>(n)].push_back(static_cast<int>(v)), ++kept;
  }

  if (const std::size_t open = openEdges(out.mesh); open > 0)
    fail("", fmt::format("the body is not a closed surface: {} of its edges have no neighbour, or more than one; close "
                         "its holes first",
                         open));
  double furthest = 0;
  std::size_t without = 0;
  out.first = {0};
  for (const std::vector<int>& list : sources) {
    std::map<int, double> sum;
    double total = 0;
    for (const int v : list) {
      double own = 0;
      for (int i = whole.first[v]; i < whole.first[v + 1]; ++i) {
        sum[whole.bone[i]] += whole.weight[i];
        own += whole.weight[i];
      }
      total += own;
      furthest = std::max(furthest, std::abs(own - 1));
    }
    if (!(total > 0)) ++without;
    for (const auto& [b, w] : sum) out.bone.push_back(b), out.weight.push_back(w / total);
    out.first.push_back(static_cast<int>(out.bone.size()));
  }
  if (without > 0)
    fail("weights", fmt::format("{} of {} vertices of the body have no weight: bind each to a bone", without,
                                out.mesh.vertices.size()));

  const std::size_t welded = kept - out.mesh.vertices.size();
  if (welded > 0) out.notes.push_back(fmt::format("{} vertices were welded to others at the same place", welded));
  if (triangles.size() > 1)
    out.notes.push_back(fmt::format("{} parts of {} triangles that are not the body were left out",
                                    triangles.size() - 1, joined.mesh.triangles.size() - out.mesh.triangles.size()));
  if (furthest > 0.01)
    out.notes.push_back(fmt::format("weights were normalised: their sums were up to {:.2f} from 1", furthest));
  return out;
}

}  // namespace gambeson
