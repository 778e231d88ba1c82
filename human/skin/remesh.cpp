#include "human/skin/remesh.hpp"
#include "core/math/parallel.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace gambeson {
namespace {

constexpr int kPasses = 8;  // edge lengths and angles no longer change by then

class Remesher {
 public:
  Remesher(const TriangleMesh& m, const ImplicitSurface& s) : s_(s), x_(m.vertices), t_(m.triangles) {
    at_.resize(x_.size());
    for (std::size_t v = 0; v < x_.size(); ++v) border_.push_back(x_[v].y == 0);
    for (std::size_t t = 0; t < t_.size(); ++t)
      for (const int v : t_[t]) at_[v].push_back(static_cast<int>(t));
  }

  TriangleMesh run() {
    for (std::size_t v = 0; v < x_.size(); ++v) x_[v] = project(x_[v], border_[v]);
    for (int pass = 0; pass < kPasses; ++pass) {
      split();
      collapse();
      flip();
      relax();
    }
    flip();
    relax();
    const int n = static_cast<int>(x_.size());
    forAll(Each::much, n, [&](int v) {
      if (!at_[v].empty()) x_[v] = project(x_[v], border_[v]);
    });
    return packed();
  }

 private:
  using Tri = std::array<int, 3>;
  static bool has(const Tri& t, int v) { return t[0] == v || t[1] == v || t[2] == v; }
  static int third(const Tri& t, int a, int b) {
    return t[0] != a && t[0] != b ? t[0] : t[1] != a && t[1] != b ? t[1] : t[2];
  }
  /// Whether the triangle runs from a to b.
  static bool runs(const Tri& t, int a, int b) {
    return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
  }
  double wanted(int a, int b) const { return s_.edge(0.5 * (x_[a] + x_[b])); }
  Vec3 normal(const Tri& t) const { return cross(x_[t[1]] - x_[t[0]], x_[t[2]] - x_[t[0]]); }

  Vec3 project(Vec3 x, bool border) const {
    for (int i = 0; i < 8; ++i) {
      if (border) x.y = 0;
      const double f = s_.value(x);
      if (std::abs(f) < 1e-7) break;  // [m]
      const Vec3 g = s_.gradient(x);
      x -= f / norm2(g) * g;
    }
    if (border) x.y = 0;
    return x;
  }
  /// Onto the surface by steps along a gradient that is known nearby.
  Vec3 projectAlong(Vec3 x, const Vec3& g, bool border) const {
    for (int i = 0; i < 2; ++i) {
      x -= s_.value(x) / norm2(g) * g;
      if (border) x.y = 0;
    }
    return x;
  }

  /// The triangles at an edge: one at the border, two elsewhere.
  int trianglesAt(int a, int b, std::array<int, 2>& pair) const {
    int n = 0;
    for (const int t : at_[a])
      if (has(t_[t], b)) {
        assert(n < 2);
        pair[n++] = t;
      }
    return n;
  }

  void neighbours(int v, std::vector<int>& out) const {
    out.clear();
    for (const int t : at_[v])
      for (const int w : t_[t])
        if (w != v) out.push_back(w);
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
  }

  /// All edges a < b, by vertices.
  std::vector<std::array<int, 2>> edges() const {
    std::vector<std::array<int, 2>> list;
    std::vector<int> around;
    for (int v = 0; v < static_cast<int>(x_.size()); ++v) {
      neighbours(v, around);
      for (const int w : around)
        if (v < w) list.push_back({v, w});
    }
    return list;
  }

  void replaceVertex(int t, int from, int to) {
    for (int& v : t_[t])
      if (v == from) v = to;
  }
  void detach(int v, int t) { at_[v].erase(std::find(at_[v].begin(), at_[v].end(), t)); }

  void split() {
    for (const auto& [a, b] : edges()) {
      if (norm(x_[a] - x_[b]) <= 4.0 / 3 * wanted(a, b)) continue;
      std::array<int, 2> pair{};
      const int n = trianglesAt(a, b, pair), m = static_cast<int>(x_.size());
      x_.push_back(project(0.5 * (x_[a] + x_[b]), n == 1));
      border_.push_back(n == 1);
      at_.emplace_back();
      for (int i = 0; i < n; ++i) {
        const int t = pair[i], c = third(t_[t], a, b), fresh = static_cast<int>(t_.size());
        t_.push_back(t_[t]);
        replaceVertex(t, b, m);
        replaceVertex(fresh, a, m);
        detach(b, t);
        at_[b].push_back(fresh);
        at_[c].push_back(fresh);
        at_[m].push_back(t);
        at_[m].push_back(fresh);
      }
    }
  }

  void collapse() {
    std::vector<int> na, nb, common;
    for (auto [a, b] : edges()) {
      if (at_[a].empty() || at_[b].empty()) continue;
      const double length = wanted(a, b);
      if (norm(x_[a] - x_[b]) >= 0.8 * length) continue;
      std::array<int, 2> pair{};
      const int n = trianglesAt(a, b, pair);
      if (n == 0 || (border_[a] && border_[b] && n != 1)) continue;
      if (border_[b] && !border_[a]) std::swap(a, b);
      neighbours(a, na);
      neighbours(b, nb);
      common.clear();
      std::set_intersection(na.begin(), na.end(), nb.begin(), nb.end(), std::back_inserter(common));
      if (static_cast<int>(common.size()) != n) continue;  // the link condition: else the surface would pinch
      const Vec3 to = border_[a] && !border_[b] ? x_[a] : project(0.5 * (x_[a] + x_[b]), border_[a]);
      if (!mayMove(a, b, to, length) || !mayMove(b, a, to, length)) continue;
      x_[a] = to;
      for (int i = 0; i < n; ++i) {
        for (const int v : t_[pair[i]])
          if (v != b) detach(v, pair[i]);
        t_[pair[i]] = {-1, -1, -1};
      }
      for (const int t : at_[b]) {
        if (t_[t][0] < 0) continue;
        replaceVertex(t, b, a);
        at_[a].push_back(t);
      }
      at_[b].clear();
    }
  }

  /// Whether v may go to `to` when its edge to w collapses: no triangle turns over, no edge becomes too long.
  bool mayMove(int v, int w, const Vec3& to, double length) const {
    for (const int t : at_[v]) {
      if (has(t_[t], w)) continue;
      const Vec3 before = normal(t_[t]);
      std::array<Vec3, 3> p;
      for (int k = 0; k < 3; ++k) {
        p[k] = t_[t][k] == v ? to : x_[t_[t][k]];
        if (t_[t][k] != v && norm(p[k] - to) > 4.0 / 3 * length) return false;
      }
      const Vec3 after = cross(p[1] - p[0], p[2] - p[0]);
      if (!(dot(before, after) > 0.7 * norm(before) * norm(after))) return false;
    }
    return true;
  }

  int valence(int v) const { return static_cast<int>(at_[v].size()) + (border_[v] ? 1 : 0); }
  int excess(int v, int change) const { return std::abs(valence(v) + change - (border_[v] ? 4 : 6)); }

  void flip() {
    for (const auto& [a, b] : edges()) {
      std::array<int, 2> pair{};
      if (trianglesAt(a, b, pair) != 2) continue;
      const int first = runs(t_[pair[0]], a, b) ? 0 : 1, t = pair[first], u = pair[1 - first];
      const int c = third(t_[t], a, b), d = third(t_[u], a, b);
      const int before = excess(a, 0) + excess(b, 0) + excess(c, 0) + excess(d, 0);
      const int after = excess(a, -1) + excess(b, -1) + excess(c, 1) + excess(d, 1);
      const auto joined = [&] {
        for (const int k : at_[c])
          if (has(t_[k], d)) return true;
        return false;
      };
      if (after >= before || joined() || (border_[c] && border_[d])) continue;
      const Tri p{c, d, b}, q{c, a, d};
      const Vec3 n = normalized(normal(t_[t])) + normalized(normal(t_[u])), np = normal(p), nq = normal(q);
      const double least = 0.9 * norm(n);
      if (!(dot(np, n) > least * norm(np) && dot(nq, n) > least * norm(nq))) continue;
      t_[t] = p;
      t_[u] = q;
      detach(a, t);
      detach(b, u);
      at_[d].push_back(t);
      at_[c].push_back(u);
    }
  }

  /// Moves each point towards the mean of its triangles' centroids, weighed by area over the wanted one; then onto the
  /// surface. A border point moves along the border.
  void relax() {
    for (int round = 0; round < 2; ++round) {
      const int n = static_cast<int>(x_.size());
      std::vector<Vec3> to = x_;
      forAll(Each::much, n, [&](int v) {
        if (at_[v].empty()) return;
        Vec3 sum;
        double weight = 0;
        if (border_[v]) {
          for (const int t : at_[v])
            for (const int w : t_[t])
              if (w != v && border_[w]) {
                const double l = norm(x_[w] - x_[v]);
                sum += l * (0.5 * (x_[v] + x_[w]));
                weight += l;
              }
        } else {
          for (const int t : at_[v]) {
            const Vec3 c = (x_[t_[t][0]] + x_[t_[t][1]] + x_[t_[t][2]]) / 3;
            const double l = s_.edge(c), area = norm(normal(t_[t])) / (l * l);
            sum += area * c;
            weight += area;
          }
        }
        if (!(weight > 0)) return;
        const Vec3 g = s_.gradient(x_[v]), move = sum / weight - x_[v];
        to[v] = projectAlong(x_[v] + move - dot(move, g) / norm2(g) * g, g, border_[v]);
      });
      x_ = std::move(to);
    }
  }

  TriangleMesh packed() const {
    TriangleMesh m;
    std::vector<int> number(x_.size(), -1);
    for (std::size_t v = 0; v < x_.size(); ++v)
      if (!at_[v].empty()) {
        number[v] = static_cast<int>(m.vertices.size());
        m.vertices.push_back(x_[v]);
      }
    for (const Tri& t : t_)
      if (t[0] >= 0) m.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    return m;
  }

  const ImplicitSurface& s_;
  std::vector<Vec3> x_;
  std::vector<Tri> t_;
  std::vector<std::vector<int>> at_;  ///< triangles at a vertex; empty: the vertex is gone
  std::vector<char> border_;
};

}  // namespace

TriangleMesh remeshHalf(const TriangleMesh& half, const ImplicitSurface& surface) {
  return Remesher(half, surface).run();
}

}  // namespace gambeson
