#include "tryon/pattern/weld_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "core/error.hpp"

namespace gambeson {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::string place(const Vec3& x) { return fmt::format("({:.2f}, {:.2f}, {:.2f}) cm", 100 * x.x, 100 * x.y, 100 * x.z); }

/// Vertices in cubes as wide as the tolerance, so that near ones lie in neighbouring cubes.
class Grid {
 public:
  explicit Grid(double width) : width_(width) {}
  /// The first vertex within the width, or -1, whereupon this one is put in.
  int nearOrAdd(const std::vector<Vec3>& vertices, int v) {
    const Vec3 x = vertices[at(v)];
    std::array<std::int64_t, 3> cube{};
    for (int c = 0; c < 3; ++c) cube[at(c)] = static_cast<std::int64_t>(std::floor(x[c] / width_));
    int best = -1;
    for (std::int64_t i = -1; i <= 1; ++i)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t k = -1; k <= 1; ++k)
          if (const auto found = cubes_.find(key(cube[0] + i, cube[1] + j, cube[2] + k)); found != cubes_.end())
            for (const int w : found->second)
              if (norm(vertices[at(w)] - x) <= width_ && (best < 0 || w < best)) best = w;
    if (best < 0) cubes_[key(cube[0], cube[1], cube[2])].push_back(v);
    return best;
  }

 private:
  static std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) {
    return static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15ULL ^
           static_cast<std::uint64_t>(j) * 0xc2b2ae3d27d4eb4fULL ^
           static_cast<std::uint64_t>(k) * 0x165667b19e3779f9ULL;
  }
  double width_;
  std::unordered_map<std::uint64_t, std::vector<int>> cubes_;
};

/// Sets that grow together.
class Groups {
 public:
  explicit Groups(std::size_t count) : of_(count) { std::iota(of_.begin(), of_.end(), 0); }
  int find(int i) {
    while (of_[at(i)] != i) i = of_[at(i)] = of_[at(of_[at(i)])];
    return i;
  }
  void join(int a, int b) {
    a = find(a), b = find(b);
    of_[at(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<int> of_;
};

class Welder {
 public:
  Welder(const ClothMesh& given, double tolerance_m, int piece)
      : given_(given), tolerance_m_(tolerance_m), piece_(piece) {}

  WeldedMesh weld() {
    join();
    if (piece_ > 0) choose();
    checkAreas();
    findEdges();
    turn();
    checkPieces();
    checkPoints();
    return std::move(out_);
  }

 private:
  [[noreturn]] void reject(int triangle, const std::string& reason) const {
    throw InputError({"", 0, fmt::format("patch \"{}\"", out_.mesh.patch_names[at(out_.mesh.patch[at(triangle)])])},
                     reason);
  }
  Vec3 x(int v) const { return out_.mesh.vertices[at(v)]; }
  Vec3 middle(int t) const {
    const auto& [a, b, c] = out_.mesh.triangles[at(t)];
    return 1.0 / 3 * (x(a) + x(b) + x(c));
  }
  int count() const { return static_cast<int>(out_.mesh.triangles.size()); }

  void join() {
    out_.mesh = given_;
    out_.mesh.vertices.clear();
    std::vector<int> name(given_.vertices.size(), -1);
    std::vector<char> used(given_.vertices.size(), 0);
    for (const auto& t : given_.triangles)
      for (const int v : t) used[at(v)] = 1;
    Grid grid(tolerance_m_);
    for (std::size_t v = 0; v < name.size(); ++v) {
      if (!used[v]) continue;
      const int near = grid.nearOrAdd(given_.vertices, static_cast<int>(v));
      if (near >= 0) {
        name[v] = name[at(near)];
        ++out_.welded;
      } else {
        name[v] = static_cast<int>(out_.mesh.vertices.size());
        out_.mesh.vertices.push_back(given_.vertices[v]);
      }
    }
    for (auto& t : out_.mesh.triangles)
      for (int& v : t) v = name[at(v)];
    for (MeshLine& line : out_.mesh.lines) {
      for (int& v : line.vertices) v = v < 0 ? -1 : name[at(v)];
      line.vertices.erase(std::unique(line.vertices.begin(), line.vertices.end()), line.vertices.end());
    }
  }

  /// Triangles by the piece that they are of, by vertices that they share; the largest first.
  std::vector<std::vector<int>> pieces() const {
    Groups groups(out_.mesh.vertices.size());
    for (const auto& t : out_.mesh.triangles) {
      groups.join(t[0], t[1]);
      groups.join(t[0], t[2]);
    }
    std::map<int, std::vector<int>> found;
    for (int t = 0; t < count(); ++t) found[groups.find(out_.mesh.triangles[at(t)][0])].push_back(t);
    std::vector<std::vector<int>> out;
    for (auto& [first, piece] : found) out.push_back(std::move(piece));
    std::stable_sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
    return out;
  }

  void choose() {
    const std::vector<std::vector<int>> all = pieces();
    if (piece_ > static_cast<int>(all.size()))
      throw InputError({"", 0, "piece"}, fmt::format("there is no piece {}; there are {}", piece_, all.size()));
    const ClothMesh whole = std::move(out_.mesh);
    ClothMesh& m = out_.mesh = {};
    std::vector<int> vertex(whole.vertices.size(), -1), patch(whole.patch_names.size(), -1);
    for (const int t : all[at(piece_ - 1)]) {
      int& p = patch[at(whole.patch[at(t)])];
      if (p < 0) {
        p = static_cast<int>(m.patch_names.size());
        m.patch_names.push_back(whole.patch_names[at(whole.patch[at(t)])]);
      }
      auto& corners = m.triangles.emplace_back(whole.triangles[at(t)]);
      for (int& v : corners) {
        int& name = vertex[at(v)];
        if (name < 0) {
          name = static_cast<int>(m.vertices.size());
          m.vertices.push_back(whole.vertices[at(v)]);
        }
        v = name;
      }
      m.patch.push_back(p);
      if (!whole.uv.empty()) m.uv.push_back(whole.uv[at(t)]);
    }
    for (MeshLine line : whole.lines) {
      line.patch = patch[at(line.patch)];
      for (int& v : line.vertices) v = v < 0 ? -1 : vertex[at(v)];
      if (line.patch >= 0 && std::find(line.vertices.begin(), line.vertices.end(), -1) == line.vertices.end())
        m.lines.push_back(std::move(line));
    }
    out_.left = static_cast<int>(whole.triangles.size() - m.triangles.size());
  }

  void checkAreas() const {
    int bad = 0, first = -1;
    for (int t = 0; t < count(); ++t) {
      const auto& [a, b, c] = out_.mesh.triangles[at(t)];
      const Vec3 ab = x(b) - x(a), ac = x(c) - x(a), bc = x(c) - x(b);
      const double longest2 = std::max({norm2(ab), norm2(ac), norm2(bc)});
      if (a != b && b != c && a != c && norm(cross(ab, ac)) > 1e-9 * longest2) continue;
      if (bad++ == 0) first = t;
    }
    if (bad == 0) return;
    reject(first,
           fmt::format("the triangle at {} has no area{}; dissolve such faces where the mesh is made (Blender: Mesh, "
                       "Clean Up, Degenerate Dissolve)",
                       place(middle(first)), bad > 1 ? fmt::format(", and {} others have none", bad - 1) : ""));
  }

  void findEdges() {
    for (int t = 0; t < count(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& corners = out_.mesh.triangles[at(t)];
        auto& beside = edges_[std::minmax({corners[k], corners[(k + 1) % 3]})];
        beside.push_back(t);
      }
    for (const auto& [edge, beside] : edges_)
      if (beside.size() > 2)
        reject(beside[0],
               fmt::format("{} triangles meet in the edge from {} to {}; cloth has two there at most: delete "
                           "doubled faces and inner layers",
                           beside.size(), place(x(edge.first)), place(x(edge.second))));
  }

  bool runs(int t, int from, int to) const {
    const auto& c = out_.mesh.triangles[at(t)];
    return (c[0] == from && c[1] == to) || (c[1] == from && c[2] == to) || (c[2] == from && c[0] == to);
  }

  void turn() {
    std::vector<std::vector<std::pair<int, bool>>> beside(at(count()));  // and whether it faces the other side
    for (const auto& [edge, two] : edges_)
      if (two.size() == 2) {
        const bool other = runs(two[0], edge.first, edge.second) == runs(two[1], edge.first, edge.second);
        beside[at(two[0])].push_back({two[1], other});
        beside[at(two[1])].push_back({two[0], other});
      }
    std::vector<int> sense(at(count()), 0);
    for (int start = 0; start < count(); ++start) {
      if (sense[at(start)] != 0) continue;
      std::vector<int> piece{start};
      sense[at(start)] = 1;
      for (std::size_t k = 0; k < piece.size(); ++k)
        for (const auto& [next, other] : beside[at(piece[k])]) {
          const int wanted = other ? -sense[at(piece[k])] : sense[at(piece[k])];
          if (sense[at(next)] == 0) {
            sense[at(next)] = wanted;
            piece.push_back(next);
          } else if (sense[at(next)] != wanted) {
            reject(next,
                   fmt::format("the cloth has one side only, as a Moebius strip has: its triangles cannot all face "
                               "one side; they meet at {}. Cut it there",
                               place(middle(next))));
          }
        }
      const auto against = std::count_if(piece.begin(), piece.end(), [&](int t) { return sense[at(t)] < 0; });
      const int turned = 2 * against > static_cast<std::ptrdiff_t>(piece.size()) ? 1 : -1;
      for (const int t : piece) {
        if (sense[at(t)] != turned) continue;
        std::swap(out_.mesh.triangles[at(t)][1], out_.mesh.triangles[at(t)][2]);
        if (!out_.mesh.uv.empty()) std::swap(out_.mesh.uv[at(t)][1], out_.mesh.uv[at(t)][2]);
        ++out_.turned;
      }
    }
  }

  /// Around a vertex the triangles hang together by edges.
  void checkPoints() const {
    std::vector<std::vector<int>> around(out_.mesh.vertices.size());
    for (int t = 0; t < count(); ++t)
      for (const int v : out_.mesh.triangles[at(t)]) around[at(v)].push_back(t);
    for (int v = 0; v < static_cast<int>(around.size()); ++v) {
      const std::vector<int>& all = around[at(v)];
      std::vector<int> fan{all[0]};
      std::vector<char> taken(all.size(), 0);
      taken[0] = 1;
      for (std::size_t k = 0; k < fan.size(); ++k)
        for (const int w : out_.mesh.triangles[at(fan[k])]) {
          if (w == v) continue;
          for (const int t : edges_.at(std::minmax({v, w}))) {
            const auto i = static_cast<std::size_t>(std::find(all.begin(), all.end(), t) - all.begin());
            if (taken[i]) continue;
            taken[i] = 1;
            fan.push_back(t);
          }
        }
      if (fan.size() < all.size())
        reject(all[0],
               fmt::format("the cloth meets itself in one point alone, at {}; sew it along an edge there, or part "
                           "the vertices",
                           place(x(v))));
    }
  }

  void checkPieces() const {
    const std::vector<std::vector<int>> all = pieces();
    if (all.size() == 1) return;
    std::string words;
    for (std::size_t k = 0; k < std::min<std::size_t>(3, all.size()); ++k)
      words += fmt::format("{}{}: {} about {}", k ? ", " : "", k + 1,
                           all[k].size() == 1 ? "1 triangle" : fmt::format("{} triangles", all[k].size()),
                           place(middle(all[k].front())));
    reject(all[1].front(),
           fmt::format(
               "is in {} pieces that hang together nowhere ({}{}). Vertices within {:g} mm are one; sew the pieces "
               "where they are made, or take one of them: --piece 1",
               all.size(), words, all.size() > 3 ? ", .." : "", 1e3 * tolerance_m_));
  }

  const ClothMesh& given_;
  double tolerance_m_;
  int piece_;
  WeldedMesh out_;
  std::map<std::pair<int, int>, std::vector<int>> edges_;  ///< triangles beside each
};

}  // namespace

WeldedMesh weldMesh(const ClothMesh& mesh, double tolerance_m, int piece) {
  return Welder(mesh, tolerance_m, piece).weld();
}

std::vector<std::vector<int>> bordersOf(const ClothMesh& mesh) {
  std::map<std::pair<int, int>, bool> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges[{t[k], t[(k + 1) % 3]}] = true;
  std::map<int, int> next;
  for (const auto& [edge, is] : edges)
    if (!edges.contains({edge.second, edge.first})) next[edge.first] = edge.second;
  std::vector<std::vector<int>> out;
  while (!next.empty()) {
    std::vector<int>& chain = out.emplace_back();
    for (auto from = next.begin(); from != next.end(); from = next.find(chain.back())) {
      if (chain.empty()) chain.push_back(from->first);
      const int to = from->second;
      next.erase(from);
      if (to == chain.front()) break;
      chain.push_back(to);
    }
  }
  std::stable_sort(out.begin(), out.end(),
                   [&](const auto& a, const auto& b) { return lengthAround(mesh, a) > lengthAround(mesh, b); });
  return out;
}

double lengthAround(const ClothMesh& mesh, const std::vector<int>& chain) {
  double length = 0;
  for (std::size_t k = 0; k < chain.size(); ++k)
    length += norm(mesh.vertices[at(chain[(k + 1) % chain.size()])] - mesh.vertices[at(chain[k])]);
  return length;
}

double areaOf(const ClothMesh& mesh, int patch) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.patch[t] != patch) continue;
    const auto& [a, b, c] = mesh.triangles[t];
    const Vec3 o = mesh.vertices[at(a)];
    area += 0.5 * norm(cross(mesh.vertices[at(b)] - o, mesh.vertices[at(c)] - o));
  }
  return area;
}

}  // namespace gambeson
