#include "human/scan/repair.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr double kWeld = 5e-6;                       ///< of the mesh's size
constexpr double kNoPart = 0.01, kSecondBody = 0.3;  ///< of the largest part's area
constexpr double kFlat = 0.03;  ///< rims that leave their plane by at most this share of their length are flat
constexpr double kFlatLonger = 2;
constexpr double kDebris = 0.05;  ///< parts in between are named, but left out

using Triangle = std::array<int, 3>;
using EdgeKey = std::pair<int, int>;

EdgeKey keyOf(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

class Repair {
 public:
  Repair(const TriangleMesh& raw, double close_share, const std::string& file, RepairReport& report)
      : mesh_(raw), close_share_(close_share), file_(file), report_(report) {
    if (mesh_.triangles.empty()) fail("", "holds no triangle");
    weld();
    keepBody();
    orient();
    closeHoles();
    outward();
    compact();
  }
  TriangleMesh take() { return std::move(mesh_); }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& reason) const {
    throw InputError({file_, 0, key}, reason);
  }
  const Vec3& x(int v) const { return mesh_.vertices[static_cast<std::size_t>(v)]; }
  static std::string place(const Vec3& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", x.x, x.y, x.z); }

  void weld() {
    Vec3 low = mesh_.vertices.front(), high = low;
    for (const Vec3& p : mesh_.vertices)
      for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], p[k]), high[k] = std::max(high[k], p[k]);
    const double size = norm(high - low);
    if (!(size > 0)) fail("", "all its vertices are at one place");
    // Vertices at exactly one place first: a mesh that is closed then needs no more, and thin parts (lips) stay apart.
    const auto bits = [](double value) { return std::bit_cast<std::int64_t>(value + 0.0); };
    join([&](const Vec3& p) { return std::array{bits(p.x), bits(p.y), bits(p.z)}; });
    if (!isClosed()) {
      const auto cell = [&](double value) { return std::int64_t{std::llround(value / (kWeld * size))}; };
      join([&](const Vec3& p) { return std::array{cell(p.x - low.x), cell(p.y - low.y), cell(p.z - low.z)}; });
    }
    if (mesh_.triangles.empty()) fail("", "holds no triangle with an area");
  }

  /// Vertices with one key become one; triangles that lose a corner, or are there already, go.
  template <class Key>
  void join(Key key) {
    std::map<std::array<std::int64_t, 3>, int> known;
    std::vector<int> to(mesh_.vertices.size());
    for (std::size_t v = 0; v < to.size(); ++v)
      to[v] = known.try_emplace(key(mesh_.vertices[v]), static_cast<int>(v)).first->second;
    std::set<Triangle> seen;
    std::vector<Triangle> kept;
    std::size_t twice = 0;
    for (Triangle t : mesh_.triangles) {
      for (int& v : t) v = to[static_cast<std::size_t>(v)];
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
      Triangle sorted = t;
      std::sort(sorted.begin(), sorted.end());
      if (seen.insert(sorted).second)
        kept.push_back(t);
      else
        ++twice;
    }
    if (twice > 0) report_.notes.push_back(fmt::format("{} triangles were there twice", twice));
    mesh_.triangles = std::move(kept);
  }

  bool isClosed() const {
    std::map<EdgeKey, int> faces;
    for (const Triangle& t : mesh_.triangles)
      for (std::size_t k = 0; k < 3; ++k) ++faces[keyOf(t[k], t[(k + 1) % 3])];
    return std::all_of(faces.begin(), faces.end(), [](const auto& e) { return e.second == 2; });
  }

  void keepBody() {
    std::vector<int> root(mesh_.vertices.size());
    std::iota(root.begin(), root.end(), 0);
    const auto find = [&](int v) {
      while (root[static_cast<std::size_t>(v)] != v)
        v = root[static_cast<std::size_t>(v)] = root[static_cast<std::size_t>(root[static_cast<std::size_t>(v)])];
      return v;
    };
    for (const Triangle& t : mesh_.triangles)
      for (int k = 1; k < 3; ++k) root[static_cast<std::size_t>(find(t[static_cast<std::size_t>(k)]))] = find(t[0]);
    std::map<int, double> area;
    std::map<int, Vec3> middle;
    for (const Triangle& t : mesh_.triangles) {
      const double a = 0.5 * norm(cross(x(t[1]) - x(t[0]), x(t[2]) - x(t[0])));
      area[find(t[0])] += a;
      middle[find(t[0])] += a / 3 * (x(t[0]) + x(t[1]) + x(t[2]));
    }
    const auto body =
        std::max_element(area.begin(), area.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    std::size_t out = 0;
    for (const auto& [part, a] : area) {
      if (part == body->first) continue;
      ++out;
      const Vec3 at = a > 0 ? middle[part] / a : x(part);
      if (a > kSecondBody * body->second)
        fail("bodies", fmt::format("holds two bodies or more: one part about {} and one about {}, of {:.0f} % of its "
                                   "area. Keep one in the file",
                                   place(middle[body->first] / body->second), place(at), 100 * a / body->second));
      if (a > kDebris * body->second)
        report_.notes.push_back(
            fmt::format("a part of {:.0f} % of the body's area about {} does not hang together "
                        "with it and was left out",
                        100 * a / body->second, place(at)));
    }
    if (out > 0) report_.notes.push_back(fmt::format("{} parts that are not the body were left out", out));
    std::erase_if(mesh_.triangles, [&](const Triangle& t) { return find(t[0]) != body->first; });
  }

  /// Makes neighbours agree on what is outside.
  void orient() {
    std::map<EdgeKey, std::vector<int>> faces;
    for (std::size_t f = 0; f < mesh_.triangles.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        faces[keyOf(mesh_.triangles[f][k], mesh_.triangles[f][(k + 1) % 3])].push_back(static_cast<int>(f));
    std::size_t crowded = 0;
    const EdgeKey* first = nullptr;
    for (const auto& [edge, list] : faces)
      if (list.size() > 2 && ++crowded == 1) first = &edge;
    if (crowded > 0)
      fail("manifold", fmt::format("{} edges belong to more than two triangles, the first at {}: sheets that are stuck "
                                   "to the body or to each other. Make it manifold (remove inner and double faces)",
                                   crowded, place(0.5 * (x(first->first) + x(first->second)))));
    const auto hasEdge = [&](int f, int a, int b) {
      const Triangle& t = mesh_.triangles[static_cast<std::size_t>(f)];
      return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
    };
    std::vector<char> done(mesh_.triangles.size(), 0);
    std::size_t turned = 0;
    for (std::size_t start = 0; start < done.size(); ++start) {
      if (done[start]) continue;
      std::vector<int> next{static_cast<int>(start)};
      done[start] = 1;
      while (!next.empty()) {
        const int f = next.back();
        next.pop_back();
        const Triangle t = mesh_.triangles[static_cast<std::size_t>(f)];
        for (std::size_t k = 0; k < 3; ++k)
          for (const int g : faces[keyOf(t[k], t[(k + 1) % 3])]) {
            if (g == f) continue;
            const bool agrees = !hasEdge(g, t[k], t[(k + 1) % 3]);
            if (done[static_cast<std::size_t>(g)]) {
              if (!agrees) fail("manifold", fmt::format("has but one side (a Moebius strip) near {}", place(x(t[k]))));
              continue;
            }
            Triangle& other = mesh_.triangles[static_cast<std::size_t>(g)];
            if (!agrees) std::swap(other[1], other[2]), ++turned;
            done[static_cast<std::size_t>(g)] = 1;
            next.push_back(g);
          }
      }
    }
    turned = std::min(turned, mesh_.triangles.size() - turned);
    if (turned > 0)
      report_.notes.push_back(fmt::format("{} triangles were turned over to agree with the others", turned));
  }

  /// Whether a plane through the middle of the rim has it all: a cut, or what stood on the ground, which a fan closes
  /// as it was.
  bool isFlat(const std::vector<int>& rim, const Vec3& middle, double length) const {
    Vec3 n;
    for (std::size_t i = 0; i < rim.size(); ++i) n += cross(x(rim[i]) - middle, x(rim[(i + 1) % rim.size()]) - middle);
    if (!(norm(n) > 0)) return false;
    n = normalized(n);
    return std::all_of(rim.begin(), rim.end(),
                       [&](int v) { return std::abs(dot(n, x(v) - middle)) <= kFlat * length; });
  }

  void closeHoles() {
    std::map<int, std::vector<int>> onward;  // of the rim, against the direction of the triangles
    {
      std::set<EdgeKey> directed;
      for (const Triangle& t : mesh_.triangles)
        for (std::size_t k = 0; k < 3; ++k) directed.insert({t[k], t[(k + 1) % 3]});
      for (const auto& [a, b] : directed)
        if (!directed.contains({b, a})) onward[b].push_back(a);
    }
    double tall = 0;
    for (int k = 0; k < 3; ++k) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Triangle& t : mesh_.triangles)
        for (const int v : t) low = std::min(low, x(v)[k]), high = std::max(high, x(v)[k]);
      tall = std::max(tall, high - low);
    }
    std::size_t holes = 0;
    double longest = 0;
    while (!onward.empty()) {
      std::vector<int> rim;
      std::map<int, std::size_t> at;
      int v = onward.begin()->first;
      // Where rims meet at a vertex the shortest loop is taken first.
      while (!at.contains(v)) {
        at[v] = rim.size();
        rim.push_back(v);
        auto& list = onward.at(v);
        const int next = list.back();
        list.pop_back();
        if (list.empty()) onward.erase(v);
        v = next;
        if (!at.contains(v) && !onward.contains(v))
          fail("manifold", fmt::format("the rim of a hole at {} does not close", place(x(v))));
      }
      for (std::size_t i = 0; i < at[v]; ++i) onward[rim[i]].push_back(rim[i + 1]);
      rim.erase(rim.begin(), rim.begin() + static_cast<std::ptrdiff_t>(at[v]));
      double length = 0;
      Vec3 mean;
      for (std::size_t i = 0; i < rim.size(); ++i) {
        length += norm(x(rim[(i + 1) % rim.size()]) - x(rim[i]));
        mean += x(rim[i]) / static_cast<double>(rim.size());
      }
      const double most = isFlat(rim, mean, length) ? kFlatLonger * close_share_ : close_share_;
      if (!(length <= most * tall))
        fail("holes", fmt::format("has a hole at {} whose rim is {:.3g} of the body's height long; those up to {:.3g} "
                                  "are closed. Close it in the file, or raise \"close_holes\"",
                                  place(mean), length / tall, most));
      longest = std::max(longest, length / tall);
      ++holes;
      const int centre = static_cast<int>(mesh_.vertices.size());
      if (rim.size() > 3) mesh_.vertices.push_back(mean);
      if (rim.size() == 3)
        mesh_.triangles.push_back({rim[0], rim[1], rim[2]});
      else
        for (std::size_t i = 0; i < rim.size(); ++i)
          mesh_.triangles.push_back({rim[i], rim[(i + 1) % rim.size()], centre});
    }
    if (holes > 0)
      report_.notes.push_back(
          fmt::format("{} holes were closed, the longest rim {:.3f} of the body's height", holes, longest));
  }

  void outward() {
    double volume = 0;
    for (const Triangle& t : mesh_.triangles) volume += dot(x(t[0]), cross(x(t[1]), x(t[2]))) / 6;
    if (volume < 0)
      for (Triangle& t : mesh_.triangles) std::swap(t[1], t[2]);
  }

  void compact() {
    std::vector<int> number(mesh_.vertices.size(), -1);
    std::vector<Vec3> kept;
    for (Triangle& t : mesh_.triangles)
      for (int& v : t) {
        int& n = number[static_cast<std::size_t>(v)];
        if (n < 0) n = static_cast<int>(kept.size()), kept.push_back(x(v));
        v = n;
      }
    mesh_.vertices = std::move(kept);
  }

  TriangleMesh mesh_;
  double close_share_;
  const std::string& file_;
  RepairReport& report_;
};

}  // namespace

TriangleMesh repaired(const TriangleMesh& raw, double close_share, const std::string& file, RepairReport& report) {
  return Repair(raw, close_share, file, report).take();
}

int handlesOf(const TriangleMesh& mesh) {
  // Euler: V - E + F = 2 - 2 handles, E = 3 F / 2.
  const auto V = static_cast<long>(mesh.vertices.size()), F = static_cast<long>(mesh.triangles.size());
  return static_cast<int>((2 - V + F / 2) / 2);
}

}  // namespace gambeson
