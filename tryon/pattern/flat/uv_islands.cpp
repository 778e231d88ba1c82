#include "tryon/pattern/flat/uv_islands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>
#include <utility>

#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

constexpr double kCorner_rad = 40 * std::numbers::pi / 180;

std::size_t at(int i) { return static_cast<std::size_t>(i); }
double distance(Vec2 a, Vec2 b) { return std::hypot(b.x - a.x, b.y - a.y); }
double twiceArea(const std::array<Vec2, 3>& c) {
  return (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y);
}

/// An edge of a triangle, in its sense, by its ends in the mesh and in uv.
using UvEnd = std::tuple<int, double, double>;
UvEnd endOf(const ClothMesh& m, int t, std::size_t k) {
  const Vec2 uv = m.uv[at(t)][k % 3];
  return {m.triangles[at(t)][k % 3], uv.x, uv.y};
}

/// Of each triangle, the number of its island: triangles of one patch that share edges in uv.
std::vector<int> islandNumbers(const ClothMesh& m, int& count) {
  const int n = static_cast<int>(m.triangles.size());
  std::map<std::tuple<int, UvEnd, UvEnd>, std::vector<int>> edges;
  for (int t = 0; t < n; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({endOf(m, t, k), endOf(m, t, k + 1)});
      edges[{m.patch[at(t)], low, high}].push_back(t);
    }
  std::vector<std::vector<int>> beside(at(n));
  for (const auto& [edge, two] : edges)
    for (std::size_t k = 1; k < two.size(); ++k) {
      beside[at(two[0])].push_back(two[k]);
      beside[at(two[k])].push_back(two[0]);
    }
  std::vector<int> island(at(n), -1);
  count = 0;
  for (int start = 0; start < n; ++start) {
    if (island[at(start)] >= 0) continue;
    std::vector<int> open{start};
    island[at(start)] = count;
    for (std::size_t k = 0; k < open.size(); ++k)
      for (const int next : beside[at(open[k])])
        if (island[at(next)] < 0) {
          island[at(next)] = count;
          open.push_back(next);
        }
    ++count;
  }
  return island;
}

}  // namespace

UvFit fitUv(const ClothMesh& m) {
  UvFit fit;
  double product = 0, square = 0;
  const auto eachEdge = [&](const auto& take) {
    for (int t = 0; t < static_cast<int>(m.triangles.size()); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        take(norm(m.vertices[at(m.triangles[at(t)][(k + 1) % 3])] - m.vertices[at(m.triangles[at(t)][k])]),
             distance(m.uv[at(t)][k], m.uv[at(t)][(k + 1) % 3]));
  };
  eachEdge([&](double l, double flat) { product += flat * l, square += flat * flat; });
  if (!(square > 0 && std::isfinite(square) && product > 0)) {
    fit.fault = "all of it is one point";
    return fit;
  }
  fit.scale_m = product / square;
  double sum = 0, weight = 0;
  fit.least = 1e300;
  eachEdge([&](double l, double flat) {
    const double ratio = fit.scale_m * flat / l;
    sum += l * (ratio - 1) * (ratio - 1), weight += l;
    fit.least = std::min(fit.least, ratio), fit.most = std::max(fit.most, ratio);
  });
  fit.rms = std::sqrt(sum / weight);
  int count = 0;
  const std::vector<int> island = islandNumbers(m, count);
  std::vector<int> sense(at(count), 0);
  int flat = 0, folded = 0;
  for (std::size_t t = 0; t < m.triangles.size(); ++t) {
    const double area = twiceArea(m.uv[t]);
    double longest2 = 0;
    for (std::size_t k = 0; k < 3; ++k)
      longest2 = std::max(longest2, std::pow(distance(m.uv[t][k], m.uv[t][(k + 1) % 3]), 2));
    if (!(std::abs(area) > 1e-9 * longest2)) {
      ++flat;
      continue;
    }
    int& its = sense[at(island[t])];
    if (its == 0) its = area > 0 ? 1 : -1;
    folded += (area > 0) != (its > 0);
  }
  if (flat > 0)
    fit.fault = fmt::format("{} triangles have no area in it", flat);
  else if (folded > 0)
    fit.fault = fmt::format("parts of it lie on their back beside others ({} triangles)", folded);
  return fit;
}

ClothMesh islandsOf(const ClothMesh& m, double scale_m, int& mirrored) {
  int count = 0;
  const std::vector<int> island = islandNumbers(m, count);
  std::vector<int> patch_of(at(count), 0), often(m.patch_names.size(), 0), number(at(count), 0);
  std::vector<char> turned(at(count), 0);
  std::vector<std::vector<int>> triangles(at(count));
  for (int t = 0; t < static_cast<int>(island.size()); ++t) {
    const int i = island[at(t)];
    if (triangles[at(i)].empty()) {
      patch_of[at(i)] = m.patch[at(t)];
      number[at(i)] = ++often[at(m.patch[at(t)])];
      turned[at(i)] = twiceArea(m.uv[at(t)]) < 0;
    }
    triangles[at(i)].push_back(t);
  }
  mirrored = static_cast<int>(std::count(turned.begin(), turned.end(), 1));
  ClothMesh out;
  out.vertices = m.vertices;
  for (int i = 0; i < count; ++i) {
    const std::string& name = m.patch_names[at(patch_of[at(i)])];
    out.patch_names.push_back(often[at(patch_of[at(i)])] > 1 ? fmt::format("{}_{}", name, number[at(i)]) : name);
    for (const int t : triangles[at(i)]) {
      out.triangles.push_back(m.triangles[at(t)]);
      out.patch.push_back(i);
      auto& corners = out.uv.emplace_back();
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = {0.0 + scale_m * (turned[at(i)] ? -m.uv[at(t)][k].x : m.uv[at(t)][k].x),  // no -0
                      0.0 + scale_m * m.uv[at(t)][k].y};
    }
  }
  // Named edges, part by part where they cross from island to island.
  std::vector<std::set<std::pair<int, int>>> edges(m.lines.empty() ? 0 : at(count));
  for (int i = 0; i < static_cast<int>(edges.size()); ++i)
    for (const int t : triangles[at(i)])
      for (std::size_t k = 0; k < 3; ++k)
        edges[at(i)].insert(std::minmax({m.triangles[at(t)][k], m.triangles[at(t)][(k + 1) % 3]}));
  for (const MeshLine& line : m.lines) {
    int now = -1;
    for (std::size_t k = 1; k < line.vertices.size(); ++k) {
      const std::pair<int, int> edge = std::minmax({line.vertices[k - 1], line.vertices[k]});
      const auto has = [&](int i) { return i >= 0 && patch_of[at(i)] == line.patch && edges[at(i)].contains(edge); };
      const int before = now;
      if (!has(now)) {
        now = 0;
        while (now < count && !has(now)) ++now;
        if (now == count) now = -1;
      }
      if (now < 0) continue;
      if (now != before) out.lines.push_back({line.name, now, {line.vertices[k - 1]}});
      out.lines.back().vertices.push_back(line.vertices[k]);
    }
  }
  return out;
}

namespace {

/// Borders of islands in uv, as edges of triangles, and which of them are one in the mesh.
class Outlines {
 public:
  explicit Outlines(const ClothMesh& m) : m_(m) {
    findBorders();
    findLoops();
    findEdges();
  }

  FlatPattern pattern(const std::string& name) const {
    FlatPattern out;
    out.name = name;
    std::vector<std::array<int, 2>> of_run(runs_.size());  // panel, edge
    for (int p = 0; p < static_cast<int>(m_.patch_names.size()); ++p) {
      Panel panel;
      panel.name = m_.patch_names[at(p)];
      std::vector<std::pair<PanelLoop, std::vector<int>>> loops;
      for (const std::vector<int>& runs : loop_runs_)
        if (m_.patch[at(triangle(runs_[at(runs[0])][0]))] == p) loops.push_back({loopOf(runs), runs});
      std::stable_sort(loops.begin(), loops.end(),
                       [](const auto& a, const auto& b) { return areaOf(a.first) > areaOf(b.first); });
      int edge = 0;
      for (auto& [loop, runs] : loops) {
        for (const int r : runs) of_run[at(r)] = {p, edge++};
        if (panel.outline.empty())
          panel.outline = std::move(loop);
        else
          panel.cutouts.push_back(std::move(loop));
      }
      out.panels.push_back(std::move(panel));
    }
    for (int r = 0; r < static_cast<int>(runs_.size()); ++r) {
      const int other = partner_[at(runs_[at(r)][0])];
      if (other < 0 || run_of_[at(other)] <= r) continue;
      const auto a = of_run[at(r)], b = of_run[at(run_of_[at(other)])];
      PanelSeam seam{fmt::format("s{}", out.seams.size() + 1), {{a[0], a[1], 0, 1}}, {{b[0], b[1], 1, 0}}};
      const int first = runs_[at(r)].front(), last = runs_[at(r)].back();
      if (next_[at(last)] == partner_[at(last)] || next_[at(partner_[at(first)])] == first) seam.use = SeamUse::dart;
      out.seams.push_back(std::move(seam));
    }
    return out;
  }

 private:
  // An edge of a triangle is the number 3 t + k.
  static int triangle(int e) { return e / 3; }
  UvEnd start(int e) const { return endOf(m_, e / 3, at(e % 3)); }
  UvEnd end(int e) const { return endOf(m_, e / 3, at(e % 3) + 1); }
  int from(int e) const { return std::get<0>(start(e)); }
  int to(int e) const { return std::get<0>(end(e)); }
  Vec2 uv(int e) const { return m_.uv[at(e / 3)][at(e % 3)]; }

  void findBorders() {
    const int n = 3 * static_cast<int>(m_.triangles.size());
    std::map<std::tuple<int, UvEnd, UvEnd>, int> flat;
    std::map<std::pair<int, int>, int> standing;
    for (int e = 0; e < n; ++e) {
      flat[{m_.patch[at(triangle(e))], start(e), end(e)}] = e;
      standing[{from(e), to(e)}] = e;
    }
    partner_.assign(at(n), -1), next_.assign(at(n), -1), run_of_.assign(at(n), -1);
    is_border_.assign(at(n), 0);
    for (int e = 0; e < n; ++e) {
      if (flat.contains({m_.patch[at(triangle(e))], end(e), start(e)})) continue;
      is_border_[at(e)] = 1;
      border_.push_back(e);
      if (const auto other = standing.find({to(e), from(e)}); other != standing.end()) partner_[at(e)] = other->second;
    }
  }

  /// The edge that follows on the border of the same island, around the triangles that meet in its end.
  void findLoops() {
    std::map<std::tuple<int, UvEnd>, std::vector<int>> starts;
    for (const int e : border_) starts[{m_.patch[at(triangle(e))], start(e)}].push_back(e);
    for (const int e : border_) {
      std::vector<int>& from_here = starts[{m_.patch[at(triangle(e))], end(e)}];
      // Where an island touches itself in a point there are several: the one that turns least to the right.
      const auto turn = [&](int f) {
        const Vec2 a = uv(e), b = uv(f), c{std::get<1>(end(f)), std::get<2>(end(f))};
        const Vec2 in{b.x - a.x, b.y - a.y}, out{c.x - b.x, c.y - b.y};
        return std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y);
      };
      const auto best =
          std::max_element(from_here.begin(), from_here.end(), [&](int a, int b) { return turn(a) < turn(b); });
      if (best == from_here.end()) continue;
      next_[at(e)] = *best;
      from_here.erase(best);
    }
  }

  double turnAfter(int e) const {
    const int f = next_[at(e)];
    const Vec2 a = uv(e), b = uv(f), c{std::get<1>(end(f)), std::get<2>(end(f))};
    const Vec2 in{b.x - a.x, b.y - a.y}, out{c.x - b.x, c.y - b.y};
    return std::abs(std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y));
  }

  /// Whether an edge of a panel ends between e and the one that follows.
  bool breaksAfter(int e) const {
    const int f = next_[at(e)], p = partner_[at(e)], q = partner_[at(f)];
    if (p < 0 && q < 0) return turnAfter(e) > kCorner_rad;
    if (p < 0 || q < 0) return true;
    if (!is_border_[at(p)] || !is_border_[at(q)]) return true;
    return p == f || next_[at(q)] != p;
  }

  void findEdges() {
    std::vector<char> breaks(partner_.size(), 0), taken(partner_.size(), 0);
    for (const int e : border_) breaks[at(e)] = next_[at(e)] < 0 || breaksAfter(e);
    for (const int first : border_) {
      if (taken[at(first)]) continue;
      std::vector<int> loop;
      for (int e = first; e >= 0 && !taken[at(e)]; e = next_[at(e)]) {
        taken[at(e)] = 1;
        loop.push_back(e);
      }
      auto start = std::find_if(loop.begin(), loop.end(), [&](int e) { return breaks[at(e)]; });
      if (start == loop.end()) {
        // A seam all around: it starts here on both sides.
        breaks[at(loop.back())] = 1;
        if (const int p = partner_[at(loop.front())]; p >= 0) breaks[at(p)] = 1;
        start = loop.end() - 1;
      }
      std::rotate(loop.begin(), start + 1, loop.end());
      loops_.push_back(loop);
    }
    for (const std::vector<int>& loop : loops_) {
      std::vector<int>& runs = loop_runs_.emplace_back();
      // A break may have been put in after the loop was turned to start at another.
      for (std::size_t k = 0; k < loop.size(); ++k) {
        if (k == 0 || breaks[at(loop[k - 1])]) {
          runs.push_back(static_cast<int>(runs_.size()));
          runs_.emplace_back();
        }
        runs_.back().push_back(loop[k]);
        run_of_[at(loop[k])] = runs.back();
      }
    }
  }

  PanelLoop loopOf(const std::vector<int>& runs) const {
    PanelLoop out;
    for (const int r : runs) {
      PanelEdge edge{"", uv(runs_[at(r)][0]), StraightEdge{}};
      PolylineEdge inner;
      for (std::size_t k = 1; k < runs_[at(r)].size(); ++k) inner.points_m.push_back(uv(runs_[at(r)][k]));
      if (!inner.points_m.empty()) edge.curve = std::move(inner);
      out.push_back(std::move(edge));
    }
    return out;
  }

  const ClothMesh& m_;
  std::vector<int> border_, partner_, next_, run_of_;
  std::vector<char> is_border_;
  std::vector<std::vector<int>> loops_, runs_, loop_runs_;  ///< edges of loops, edges of runs, runs of loops
};

}  // namespace

FlatPattern flatOfIslands(const ClothMesh& islands, const std::string& name) { return Outlines(islands).pattern(name); }

}  // namespace gambeson
