#include "core/math/planar_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "core/error.hpp"

namespace gambeson {
namespace {

constexpr double kNearest = 0.6;  // of the spacing: a point inside from the border
constexpr int kSmoothings = 6;

Vec2 minus(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// Twice the area of a, b, c, counter-clockwise positive.
double turn(Vec2 a, Vec2 b, Vec2 c) { return cross(minus(b, a), minus(c, a)); }

[[noreturn]] void reject(const std::string& reason) { throw InputError({"", 0, "outline"}, reason); }

/// The smallest height of a triangle over its longest edge.
double flatnessOf(Vec2 a, Vec2 b, Vec2 c) {
  const double longest =
      std::max({dot(minus(b, a), minus(b, a)), dot(minus(c, b), minus(c, b)), dot(minus(a, c), minus(a, c))});
  return longest > 0 ? turn(a, b, c) / longest : 0;
}

double distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 way = minus(b, a), to = minus(p, a);
  const double length2 = dot(way, way), t = length2 > 0 ? std::clamp(dot(to, way) / length2, 0.0, 1.0) : 0;
  return std::hypot(to.x - t * way.x, to.y - t * way.y);
}

/// Whether two segments cross or touch, but for ends in common.
bool crosses(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto same = [](Vec2 p, Vec2 q) { return p.x == q.x && p.y == q.y; };
  if (same(a, c) || same(a, d) || same(b, c) || same(b, d)) return false;
  return turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
}

class Mesher {
 public:
  Mesher(std::span<const std::vector<Vec2>> loops, double spacing) : loops_(loops), h_(spacing) {
    for (const std::vector<Vec2>& loop : loops) {
      if (loop.size() < 3) reject("a loop has fewer than three points");
      first_.push_back(static_cast<int>(p_.size()));
      p_.insert(p_.end(), loop.begin(), loop.end());
    }
    border_ = static_cast<int>(p_.size());
    first_.push_back(border_);
  }

  PlanarMesh run() {
    clipEars(joined());
    findNeighbours();
    flipAll();
    addInside();
    for (int k = 0; k < kSmoothings; ++k) {
      smooth();
      flipAll();
    }
    PlanarMesh out{std::move(p_), {}};
    for (const Triangle& t : t_) out.triangles.push_back(t.v);
    return out;
  }

 private:
  struct Triangle {
    std::array<int, 3> v;
    std::array<int, 3> beside{-1, -1, -1};  ///< over the edge that faces each corner; -1: border
  };

  Vec2 at(int i) const { return p_[static_cast<std::size_t>(i)]; }
  Triangle& tri(int t) { return t_[static_cast<std::size_t>(t)]; }

  /// All loops as one, by bridges that are run both ways.
  std::vector<int> joined() const {
    std::vector<std::pair<int, int>> edges;
    for (std::size_t l = 0; l + 1 < first_.size(); ++l)
      for (int i = first_[l]; i < first_[l + 1]; ++i) edges.emplace_back(i, i + 1 < first_[l + 1] ? i + 1 : first_[l]);
    std::vector<int> chain(static_cast<std::size_t>(first_[1]));
    std::iota(chain.begin(), chain.end(), 0);
    for (std::size_t l = 1; l + 1 < first_.size(); ++l) {
      double least = std::numeric_limits<double>::infinity();
      std::size_t from = 0;
      int to = -1;
      for (std::size_t k = 0; k < chain.size(); ++k)
        for (int i = first_[l]; i < first_[l + 1]; ++i) {
          const Vec2 a = at(chain[k]), b = at(i), way = minus(b, a);
          if (!(dot(way, way) < least)) continue;
          if (std::any_of(edges.begin(), edges.end(),
                          [&](const auto& e) { return crosses(a, b, at(e.first), at(e.second)); }))
            continue;
          least = dot(way, way), from = k, to = i;
        }
      if (to < 0) reject("a cutout does not lie within the outline");
      std::vector<int> detour;
      for (int i = to; i < first_[l + 1]; ++i) detour.push_back(i);
      for (int i = first_[l]; i <= to; ++i) detour.push_back(i);
      detour.push_back(chain[from]);
      edges.emplace_back(chain[from], to);
      chain.insert(chain.begin() + static_cast<long>(from) + 1, detour.begin(), detour.end());
    }
    return chain;
  }

  /// The flatness of the ear at a place of the chain; below 0 where it is none.
  double ear(const std::vector<int>& chain, std::size_t k) const {
    const std::size_t n = chain.size();
    const int a = chain[(k + n - 1) % n], b = chain[k], c = chain[(k + 1) % n];
    const double quality = flatnessOf(at(a), at(b), at(c));
    if (!(quality > 1e-9)) return -1;
    for (const int i : chain) {
      if (i == a || i == b || i == c) continue;
      const Vec2 p = at(i);
      if (turn(at(a), at(b), p) >= 0 && turn(at(b), at(c), p) >= 0 && turn(at(c), at(a), p) >= 0) return -1;
    }
    return quality;
  }

  void clipEars(std::vector<int> chain) {
    std::vector<double> quality(chain.size());
    const auto lookAt = [&](std::size_t k) { quality[k] = ear(chain, k); };
    for (std::size_t k = 0; k < chain.size(); ++k) lookAt(k);
    while (chain.size() > 3) {
      std::size_t best = static_cast<std::size_t>(std::max_element(quality.begin(), quality.end()) - quality.begin());
      if (quality[best] < 0) {  // what stood in an ear may be gone
        for (std::size_t k = 0; k < chain.size(); ++k) lookAt(k);
        best = static_cast<std::size_t>(std::max_element(quality.begin(), quality.end()) - quality.begin());
        if (quality[best] < 0) reject("it crosses itself");
      }
      const std::size_t n = chain.size();
      t_.push_back({{chain[(best + n - 1) % n], chain[best], chain[(best + 1) % n]}});
      chain.erase(chain.begin() + static_cast<long>(best));
      quality.erase(quality.begin() + static_cast<long>(best));
      lookAt((best + n - 2) % (n - 1));
      lookAt(best % (n - 1));
    }
    if (!(turn(at(chain[0]), at(chain[1]), at(chain[2])) > 0)) reject("it crosses itself, or runs clockwise");
    t_.push_back({{chain[0], chain[1], chain[2]}});
  }

  void findNeighbours() {
    std::map<std::pair<int, int>, std::pair<int, std::size_t>> open;
    for (int t = 0; t < static_cast<int>(t_.size()); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const int from = tri(t).v[(k + 1) % 3], to = tri(t).v[(k + 2) % 3];
        if (const auto other = open.find({to, from}); other != open.end()) {
          tri(t).beside[k] = other->second.first;
          tri(other->second.first).beside[other->second.second] = t;
        } else {
          open[{from, to}] = {t, k};
        }
      }
  }

  /// Which corner of u faces the edge over which t lies.
  std::size_t facing(int u, int t) {
    for (std::size_t k = 0; k < 2; ++k)
      if (tri(u).beside[k] == t) return k;
    return 2;
  }

  /// Flips the edge that faces corner k of t where the angles over it sum to more than pi and what comes is no worse.
  bool flip(int t, std::size_t k) {
    const int u = tri(t).beside[k];
    if (u < 0) return false;
    const std::size_t l = facing(u, t);
    const int a = tri(t).v[k], b = tri(t).v[(k + 1) % 3], c = tri(t).v[(k + 2) % 3], d = tri(u).v[l];
    const Vec2 ab = minus(at(b), at(a)), ac = minus(at(c), at(a)), dc = minus(at(c), at(d)), db = minus(at(b), at(d));
    const double size = dot(ab, ab) + dot(ac, ac) + dot(dc, dc) + dot(db, db);
    if (!(cross(ab, ac) * dot(dc, db) + dot(ab, ac) * cross(dc, db) < -1e-10 * size * size)) return false;
    if (!(turn(at(a), at(b), at(d)) > 1e-10 * size && turn(at(a), at(d), at(c)) > 1e-10 * size)) return false;
    const int over_ab = tri(t).beside[(k + 2) % 3], over_ca = tri(t).beside[(k + 1) % 3];
    const int over_bd = tri(u).beside[(l + 1) % 3], over_dc = tri(u).beside[(l + 2) % 3];
    tri(t) = {{a, b, d}, {over_bd, u, over_ab}};
    tri(u) = {{a, d, c}, {over_dc, over_ca, t}};
    if (over_bd >= 0) tri(over_bd).beside[facing(over_bd, u)] = t;
    if (over_ca >= 0) tri(over_ca).beside[facing(over_ca, t)] = u;
    return true;
  }

  void flipAll() {
    for (std::size_t round = 0; round < 100; ++round) {
      bool any = false;
      for (int t = 0; t < static_cast<int>(t_.size()); ++t)
        for (std::size_t k = 0; k < 3; ++k) any = flip(t, k) || any;
      if (!any) return;
    }
  }

  bool isInside(Vec2 p) const {
    bool inside = false;
    for (const std::vector<Vec2>& loop : loops_)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec2 a = loop[i], b = loop[(i + 1) % loop.size()];
        if (distance(p, a, b) < kNearest * h_) return false;
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
      }
    return inside;
  }

  void addInside() {
    Vec2 low = p_[0], high = p_[0];
    for (const Vec2 p : p_) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const double row = 0.5 * std::sqrt(3.0) * h_;
    // From the middle, so that what is symmetric is meshed alike on both sides but for the last row.
    const Vec2 middle{0.5 * (low.x + high.x), 0.5 * (low.y + high.y)};
    const int rows = static_cast<int>((high.y - low.y) / (2 * row)) + 1,
              columns = static_cast<int>((high.x - low.x) / (2 * h_)) + 1;
    int near = 0;
    for (int j = -rows; j <= rows; ++j)
      for (int i = -columns; i <= columns; ++i) {
        const Vec2 p{middle.x + h_ * (i + (j % 2 == 0 ? 0 : 0.5)), middle.y + row * j};
        if (isInside(p)) near = insert(p, near);
      }
  }

  /// The triangle that a point lies in, walked to from another.
  int find(Vec2 p, int t) {
    for (std::size_t step = 0; step < t_.size(); ++step) {
      std::size_t out = 3;
      double least = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double side = turn(at(tri(t).v[(k + 1) % 3]), at(tri(t).v[(k + 2) % 3]), p);
        if (side < least && tri(t).beside[k] >= 0) least = side, out = k;
      }
      if (out == 3) break;
      t = tri(t).beside[out];
    }
    const auto depth = [&](int k) {
      const auto& v = tri(k).v;
      return std::min({turn(at(v[0]), at(v[1]), p), turn(at(v[1]), at(v[2]), p), turn(at(v[2]), at(v[0]), p)});
    };
    if (depth(t) >= 0) return t;
    for (int k = 0; k < static_cast<int>(t_.size()); ++k)  // the walk ended at the border
      if (depth(k) > depth(t)) t = k;
    return t;
  }

  int insert(Vec2 p, int near) {
    const int t = find(p, near), n = static_cast<int>(p_.size()), u = static_cast<int>(t_.size()), w = u + 1;
    p_.push_back(p);
    const Triangle old = tri(t);
    const auto [a, b, c] = old.v;
    tri(t) = {{a, b, n}, {u, w, old.beside[2]}};
    t_.push_back({{b, c, n}, {w, t, old.beside[0]}});
    t_.push_back({{c, a, n}, {t, u, old.beside[1]}});
    if (old.beside[0] >= 0) tri(old.beside[0]).beside[facing(old.beside[0], t)] = u;
    if (old.beside[1] >= 0) tri(old.beside[1]).beside[facing(old.beside[1], t)] = w;
    std::vector<int> open{t, u, w};
    while (!open.empty()) {
      const int top = open.back();
      open.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        if (tri(top).v[k] != n) continue;
        const int other = tri(top).beside[k];
        if (flip(top, k)) open.push_back(top), open.push_back(other);
        break;
      }
    }
    return t;
  }

  /// Each point inside goes to the middle of its neighbours, where no triangle about it becomes flatter than it may.
  void smooth() {
    constexpr double kFlattest = 0.2;
    std::vector<std::vector<int>> around(p_.size());
    for (int t = 0; t < static_cast<int>(t_.size()); ++t)
      for (const int v : tri(t).v) around[static_cast<std::size_t>(v)].push_back(t);
    for (int i = border_; i < static_cast<int>(p_.size()); ++i) {
      Vec2 sum{};
      double least = 1;
      const auto& own = around[static_cast<std::size_t>(i)];
      const auto flattest = [&] {
        double q = 1;
        for (const int t : own) q = std::min(q, flatnessOf(at(tri(t).v[0]), at(tri(t).v[1]), at(tri(t).v[2])));
        return q;
      };
      for (const int t : own)
        for (const int v : tri(t).v)
          if (v != i) sum = {sum.x + at(v).x, sum.y + at(v).y};
      least = std::min(kFlattest, flattest());
      const Vec2 before = at(i);
      const double count = 2 * static_cast<double>(own.size());
      p_[static_cast<std::size_t>(i)] = {sum.x / count, sum.y / count};
      if (flattest() < least) p_[static_cast<std::size_t>(i)] = before;
    }
  }

  std::span<const std::vector<Vec2>> loops_;
  double h_;
  std::vector<Vec2> p_;
  std::vector<int> first_;  ///< point of each loop, and the end
  int border_ = 0;
  std::vector<Triangle> t_;
};

}  // namespace

PlanarMesh planarMesh(std::span<const std::vector<Vec2>> loops, double spacing) {
  if (!(spacing > 0) || loops.empty()) reject("needs a loop, and a spacing > 0");
  return Mesher(loops, spacing).run();
}

double flatness(const PlanarMesh& mesh, std::size_t triangle) {
  const auto at = [&](std::size_t k) { return mesh.points[static_cast<std::size_t>(mesh.triangles[triangle][k])]; };
  return flatnessOf(at(0), at(1), at(2));
}

}  // namespace gambeson
