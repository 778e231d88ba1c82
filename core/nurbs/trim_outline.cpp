#include "core/nurbs/trim_outline.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/error.hpp"

namespace gambeson {
namespace {

Vec2 minus(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// Whether the line segments a b and c d cross inside both, or one's end lies within the other.
bool crosses(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const double c1 = cross(minus(b, a), minus(c, a)), c2 = cross(minus(b, a), minus(d, a));
  const double c3 = cross(minus(d, c), minus(a, c)), c4 = cross(minus(d, c), minus(b, c));
  return c1 * c2 <= 0 && c3 * c4 <= 0 && !(c1 == 0 && c2 == 0 && c3 == 0 && c4 == 0);
}

/// A stretch of a loop within a cell: vertices, with their tangents' directions left to the chords.
using Chain = std::vector<int>;

class Cutter {
 public:
  Cutter(const TrimBoundary& b, std::span<const double> us, std::span<const double> vs)
      : b_(b), us_(us), vs_(vs), nu_(static_cast<int>(us.size())), nv_(static_cast<int>(vs.size())) {}

  Outline run() {
    addLoops();
    addGrid();
    for (int j = 0; j + 1 < nv_; ++j)
      for (int i = 0; i + 1 < nu_; ++i) addCell(i, j);
    return std::move(out_);
  }

 private:
  int vertex(Vec2 p, OutlineRank rank) {
    const auto [it, is_new] = index_.try_emplace({p.x, p.y}, static_cast<int>(out_.uv.size()));
    if (is_new) {
      out_.uv.push_back(p);
      out_.rank.push_back(rank);
      // On a grid line between its points: both cells beside it have the vertex.
      const int i = lineAt(us_, p.x), j = lineAt(vs_, p.y);
      if (i >= 0 && j < 0) on_u_line_[{i, cellAt(vs_, p.y)}].push_back(it->second);
      if (j >= 0 && i < 0) on_v_line_[{cellAt(us_, p.x), j}].push_back(it->second);
    }
    out_.rank[it->second] = std::max(out_.rank[it->second], rank);
    return it->second;
  }
  static int lineAt(std::span<const double> lines, double x) {
    const auto it = std::lower_bound(lines.begin(), lines.end(), x);
    return it != lines.end() && *it == x ? static_cast<int>(it - lines.begin()) : -1;
  }
  static int cellAt(std::span<const double> lines, double x) {
    return static_cast<int>(std::upper_bound(lines.begin(), lines.end(), x) - lines.begin()) - 1;
  }

  /// Parameters between the ends of an arc at which it is divided.
  void divide(const MonotoneArc& arc, double t0, Vec2 a, double t1, Vec2 c, double hu, double hv, int halvings,
              std::vector<double>& at) const {
    const double mid = 0.5 * (t0 + t1);
    const Vec2 m = b_.point(arc, mid);
    const Vec2 chord{(c.x - a.x) / hu, (c.y - a.y) / hv}, off{(m.x - a.x) / hu, (m.y - a.y) / hv};
    const double length = std::hypot(chord.x, chord.y);
    if (!(length > 0)) return;
    if (halvings <= 0 && !(std::abs(cross(chord, off)) > 0.05 * length)) return;
    if (halvings < -8) return;
    divide(arc, t0, a, mid, m, hu, hv, halvings - 1, at);
    at.push_back(mid);
    divide(arc, mid, m, t1, c, hu, hv, halvings - 1, at);
  }

  void addLoops() {
    const GridArcs g = splitAtGrid(b_, us_, vs_);
    for (std::size_t loop = 0; loop + 1 < g.first_arc.size(); ++loop) {
      const int first = g.first_arc[loop], last = g.first_arc[loop + 1], count = last - first;
      const int halvings = count >= 8 ? 0 : count >= 4 ? 1 : 2;
      Chain open;                 // the chain that is being built
      std::array<int, 2> cell{};  // and its cell
      std::vector<std::pair<std::array<int, 2>, Chain>> chains;
      for (int k = first; k < last; ++k) {
        const MonotoneArc& arc = g.arcs[k];
        const auto here = gridCell(arc, us_, vs_);
        std::vector<int> points{vertex(arc.a, arc.corner ? OutlineRank::corner : OutlineRank::edge)};
        if (here[0] >= 0) {
          std::vector<double> at;
          divide(arc, arc.t0, arc.a, arc.t1, arc.b, us_[here[0] + 1] - us_[here[0]], vs_[here[1] + 1] - vs_[here[1]],
                 halvings, at);
          for (double t : at) points.push_back(vertex(b_.point(arc, t), OutlineRank::edge));
        }
        points.push_back(vertex(arc.b, OutlineRank::edge));
        for (int p : points) on_loop_.insert(p);
        if (here[0] < 0) {  // along a grid line: no cell's inside is cut
          if (!open.empty()) chains.push_back({cell, std::move(open)});
          open.clear();
          continue;
        }
        const bool on_line = lineAt(us_, arc.a.x) >= 0 || lineAt(vs_, arc.a.y) >= 0;
        if (!open.empty() && (on_line || here != cell)) {
          chains.push_back({cell, std::move(open)});
          open.clear();
        }
        cell = here;
        open.insert(open.end(), points.begin() + (open.empty() ? 0 : 1), points.end());
      }
      if (!open.empty()) chains.push_back({cell, std::move(open)});
      // The loop's start is no end: join the last chain to the first unless a grid line lies between.
      const Vec2 start = g.arcs[first].a;
      const bool on_line = lineAt(us_, start.x) >= 0 || lineAt(vs_, start.y) >= 0;
      if (chains.size() > 1 && !on_line && chains.front().second.front() == chains.back().second.back()) {
        Chain joined = std::move(chains.back().second);
        joined.insert(joined.end(), chains.front().second.begin() + 1, chains.front().second.end());
        chains.front().second = std::move(joined);
        chains.pop_back();
      }
      for (auto& [where, chain] : chains) {
        thin(chain, us_[where[0] + 1] - us_[where[0]], vs_[where[1] + 1] - vs_[where[1]]);
        auto& list = where_[where];
        const Vec2 a = out_.uv[chain.front()];
        const bool closed = chain.front() == chain.back() && lineAt(us_, a.x) < 0 && lineAt(vs_, a.y) < 0;
        (closed ? list.closed : list.open).push_back(std::move(chain));
      }
    }
  }

  /// Leaves out what is no corner and lies within 0.05 of a cell of its neighbours' chord: the loop's extremes, which
  /// would hinder grid samples beside them from moving onto the loop.
  void thin(Chain& chain, double hu, double hv) const {
    if (chain.front() == chain.back()) return;
    for (std::size_t k = 1; k + 1 < chain.size();) {
      const Vec2 a = out_.uv[chain[k - 1]], m = out_.uv[chain[k]], c = out_.uv[chain[k + 1]];
      const Vec2 chord{(c.x - a.x) / hu, (c.y - a.y) / hv}, off{(m.x - a.x) / hu, (m.y - a.y) / hv};
      if (out_.rank[chain[k]] == OutlineRank::edge &&
          std::abs(cross(chord, off)) <= 0.05 * std::hypot(chord.x, chord.y))
        chain.erase(chain.begin() + static_cast<long>(k));
      else
        ++k;
    }
  }

  void addGrid() {
    out_.grid.assign(static_cast<std::size_t>(nu_) * nv_, -1);
    for (int j = 0; j < nv_; ++j)
      for (int i = 0; i < nu_; ++i) {
        const Vec2 p{us_[i], vs_[j]};
        const auto it = index_.find({p.x, p.y});
        const bool border_u = i == 0 || i == nu_ - 1, border_v = j == 0 || j == nv_ - 1;
        const OutlineRank rank = border_u && border_v   ? OutlineRank::corner
                                 : border_u || border_v ? OutlineRank::edge
                                                        : OutlineRank::inner;
        if (it != index_.end())
          out_.grid[i + nu_ * j] = it->second;
        else if (b_.winding({std::clamp(p.x, b_.u0 + b_.eps_u, b_.u1 - b_.eps_u),
                             std::clamp(p.y, b_.v0 + b_.eps_v, b_.v1 - b_.eps_v)}) > 0)
          out_.grid[i + nu_ * j] = vertex(p, rank);
      }
    // Where a loop meets the border, the outline turns.
    for (int p : on_loop_) {
      const Vec2 at = out_.uv[p];
      if (at.x == us_.front() || at.x == us_.back() || at.y == vs_.front() || at.y == vs_.back())
        out_.rank[p] = OutlineRank::corner;
    }
  }

  /// Vertices around a cell from its lower left corner, counter-clockwise, with s in [0, 4).
  std::vector<std::pair<double, int>> around(int i, int j) const {
    std::vector<std::pair<double, int>> list;
    const double u0 = us_[i], u1 = us_[i + 1], v0 = vs_[j], v1 = vs_[j + 1];
    const auto add = [&](int p) {
      if (p < 0) return;
      const Vec2 at = out_.uv[p];
      const double x = (at.x - u0) / (u1 - u0), y = (at.y - v0) / (v1 - v0);
      list.push_back({at.y == v0 && at.x < u1   ? x
                      : at.x == u1 && at.y < v1 ? 1 + y
                      : at.y == v1 && at.x > u0 ? 3 - x
                                                : 4 - y,
                      p});
    };
    for (int y : {j, j + 1})
      for (int x : {i, i + 1}) add(out_.grid[x + nu_ * y]);
    for (int x : {i, i + 1})
      if (const auto it = on_u_line_.find({x, j}); it != on_u_line_.end())
        for (int p : it->second) add(p);
    for (int y : {j, j + 1})
      if (const auto it = on_v_line_.find({i, y}); it != on_v_line_.end())
        for (int p : it->second) add(p);
    std::sort(list.begin(), list.end());
    return list;
  }

  void addCell(int i, int j) {
    Outline::Cell cell{i, j, false, {}};
    const auto ring = around(i, j);
    const auto found = where_.find({i, j});
    if (found == where_.end() || found->second.open.empty()) {
      const Vec2 mid{0.5 * (us_[i] + us_[i + 1]), 0.5 * (vs_[j] + vs_[j + 1])};
      // With loops inside the cell its corner tells, else its middle.
      const bool kept = found == where_.end() ? b_.winding(mid) > 0 : windingAtCorner(i, j) > 0;
      if (kept) {
        cell.polygons.emplace_back();
        for (const auto& entry : ring) cell.polygons.back().push_back(entry.second);
        cell.whole = found == where_.end() && ring.size() == 4;
      }
    } else {
      trace(ring, found->second.open, cell);
    }
    if (found != where_.end()) {
      std::vector<Chain> holes;
      for (Chain loop : found->second.closed) {
        loop.pop_back();
        (areaOf(loop) > 0 ? cell.polygons : holes).push_back(std::move(loop));
      }
      for (std::size_t h = 0; h < holes.size(); ++h) bridge(holes, h, cell);
    }
    std::erase_if(cell.polygons, [](const Chain& p) { return p.size() < 3; });
    if (!cell.polygons.empty()) out_.cells.push_back(std::move(cell));
  }

  int windingAtCorner(int i, int j) const {
    // A whole loop in the cell keeps clear of the corner.
    return b_.winding({us_[i] + 4 * b_.eps_u, vs_[j] + 4 * b_.eps_v});
  }

  double areaOf(const Chain& p) const {
    double area = 0;
    const Vec2 o = out_.uv[p[0]];
    for (std::size_t k = 1; k + 1 < p.size(); ++k)
      area += 0.5 * cross(minus(out_.uv[p[k]], o), minus(out_.uv[p[k + 1]], o));
    return area;
  }

  /// Follows the loop through the cell (what is kept lies to its left), then the cell's border counter-clockwise to
  /// where the loop enters again.
  void trace(const std::vector<std::pair<double, int>>& ring, const std::vector<Chain>& chains, Outline::Cell& cell) {
    const int n = static_cast<int>(ring.size());
    const auto at = [&](int p) {
      for (int k = 0; k < n; ++k)
        if (ring[k].second == p) return k;
      throw InputError({"", 0, "loops"}, "a loop leaves a cell of the sample grid other than through its border");
    };
    std::vector<char> done(chains.size(), 0);
    const auto startsAt = [&](int p) {
      for (std::size_t c = 0; c < chains.size(); ++c)
        if (chains[c].front() == p) return static_cast<int>(c);
      return -1;
    };
    for (std::size_t first = 0; first < chains.size(); ++first) {
      if (done[first]) continue;
      Chain polygon;
      int chain = static_cast<int>(first);
      while (chain >= 0 && !done[chain]) {
        done[chain] = 1;
        const Chain& c = chains[chain];
        polygon.insert(polygon.end(), c.begin(), c.end() - 1);
        int k = at(c.back()), next = startsAt(c.back());
        if (next >= 0) {
          // The loop touches the border here and goes on: kept between its two branches, or to both sides of them.
          const Vec2 p = out_.uv[c.back()], q = out_.uv[ring[(k + 1) % n].second];
          const Vec2 along = minus(q, p), in = minus(out_.uv[c[c.size() - 2]], p),
                     on = minus(out_.uv[chains[next][1]], p);
          const auto angle = [&](Vec2 w) { return std::atan2(cross(along, w), along.x * w.x + along.y * w.y); };
          if (angle(in) > angle(on)) {
            chain = next;
            continue;
          }
        }
        next = -1;
        for (int steps = 0; steps < n && next < 0; ++steps) {
          polygon.push_back(ring[k].second);
          k = (k + 1) % n;
          next = startsAt(ring[k].second);
        }
        chain = next;
      }
      cell.polygons.push_back(std::move(polygon));
    }
  }

  /// Joins a hole to the polygon about it by the shortest bridge that crosses nothing.
  void bridge(const std::vector<Chain>& holes, std::size_t which, Outline::Cell& cell) const {
    const Chain& hole = holes[which];
    Chain* best_polygon = nullptr;
    std::size_t best_outer = 0, best_inner = 0;
    double best = 1e300;
    const double hu = us_[cell.i + 1] - us_[cell.i], hv = vs_[cell.j + 1] - vs_[cell.j];
    for (Chain& polygon : cell.polygons) {
      if (!contains(polygon, out_.uv[hole[0]])) continue;
      for (std::size_t o = 0; o < polygon.size(); ++o)
        for (std::size_t h = 0; h < hole.size(); ++h) {
          const Vec2 a = out_.uv[polygon[o]], c = out_.uv[hole[h]];
          const double length = std::hypot((a.x - c.x) / hu, (a.y - c.y) / hv);
          if (length >= best) continue;
          bool free = true;
          const auto check = [&](const Chain& ring) {
            for (std::size_t k = 0; k < ring.size() && free; ++k) {
              const int p = ring[k], q = ring[(k + 1) % ring.size()];
              if (p == polygon[o] || q == polygon[o] || p == hole[h] || q == hole[h]) continue;
              free = !crosses(a, c, out_.uv[p], out_.uv[q]);
            }
          };
          check(polygon);
          for (std::size_t k = which; k < holes.size(); ++k) check(holes[k]);
          if (!free) continue;
          best = length, best_polygon = &polygon, best_outer = o, best_inner = h;
        }
    }
    if (!best_polygon) throw InputError({"", 0, "loops"}, "a hole within one cell of the sample grid cannot be meshed");
    Chain joined(best_polygon->begin(), best_polygon->begin() + static_cast<long>(best_outer) + 1);
    for (std::size_t k = 0; k <= hole.size(); ++k) joined.push_back(hole[(best_inner + k) % hole.size()]);
    joined.insert(joined.end(), best_polygon->begin() + static_cast<long>(best_outer), best_polygon->end());
    *best_polygon = std::move(joined);
  }

  bool contains(const Chain& polygon, Vec2 p) const {
    bool inside = false;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec2 a = out_.uv[polygon[k]], b = out_.uv[polygon[(k + 1) % polygon.size()]];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
  }

  struct Chains {
    std::vector<Chain> open, closed;
  };
  const TrimBoundary& b_;
  std::span<const double> us_, vs_;
  int nu_, nv_;
  Outline out_;
  std::map<std::pair<double, double>, int> index_;
  std::map<std::array<int, 2>, std::vector<int>> on_u_line_, on_v_line_;  ///< by (line, cell) and (cell, line)
  std::map<std::array<int, 2>, Chains> where_;
  std::set<int> on_loop_;
};

}  // namespace

Outline cutGrid(const TrimBoundary& boundary, std::span<const double> us, std::span<const double> vs) {
  return Cutter(boundary, us, vs).run();
}

}  // namespace gambeson
