#include "cases/pattern/dxf_loops.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gambeson {
namespace {

constexpr double kMeet_m = 1e-4, kTurn_m = 2e-5, kSame_m = 1e-6, kCorner_rad = 30 * std::numbers::pi / 180;

double distance(Vec2 a, Vec2 b) { return std::hypot(b.x - a.x, b.y - a.y); }

void reverse(DxfChain& c) {
  std::reverse(c.points.begin(), c.points.end());
  // The bulge of a line belongs to its first point, which was its last.
  std::reverse(c.bulges.begin(), c.bulges.end() - 1);
  for (double& b : c.bulges) b = -b;
}

/// Leaves out points that equal the one before; closes what ends where it starts.
void tidy(DxfChain& c) {
  DxfChain out;
  for (std::size_t k = 0; k < c.points.size(); ++k) {
    if (!out.points.empty() && distance(out.points.back(), c.points[k]) <= kSame_m) {
      out.bulges.back() = c.bulges[k];
      continue;
    }
    out.points.push_back(c.points[k]);
    out.bulges.push_back(c.bulges[k]);
  }
  out.closed = c.closed;
  if (out.points.size() > 2 && distance(out.points.front(), out.points.back()) <= (c.closed ? kSame_m : kMeet_m)) {
    out.points.pop_back();
    out.bulges.pop_back();
    out.closed = true;
  }
  c = std::move(out);
}

/// Adds b behind a, whose end it starts at.
void append(DxfChain& a, const DxfChain& b) {
  a.points.pop_back();
  a.bulges.pop_back();
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  a.bulges.insert(a.bulges.end(), b.bulges.begin(), b.bulges.end());
}

/// Joins open chains whose ends meet, first to last.
void join(std::vector<DxfChain>& chains) {
  for (std::size_t a = 0; a < chains.size(); ++a) {
    for (bool grew = true; grew && !chains[a].closed;) {
      grew = false;
      for (std::size_t b = a + 1; b < chains.size() && !grew; ++b) {
        if (chains[b].closed) continue;
        const Vec2 end = chains[a].points.back(), start = chains[a].points.front();
        if (distance(end, chains[b].points.back()) <= kMeet_m || distance(start, chains[b].points.front()) <= kMeet_m)
          reverse(chains[b]);
        if (distance(end, chains[b].points.front()) <= kMeet_m) {
          append(chains[a], chains[b]);
        } else if (distance(start, chains[b].points.back()) <= kMeet_m) {
          append(chains[b], chains[a]);
          std::swap(chains[a], chains[b]);
        } else {
          continue;
        }
        chains.erase(chains.begin() + static_cast<std::ptrdiff_t>(b));
        tidy(chains[a]);
        grew = true;
      }
    }
  }
}

double angleAt(const DxfChain& c, std::size_t k) {
  const std::size_t n = c.points.size();
  const Vec2 a = c.points[(k + n - 1) % n], b = c.points[k], d = c.points[(k + 1) % n];
  const Vec2 in{b.x - a.x, b.y - a.y}, out{d.x - b.x, d.y - b.y};
  return std::abs(std::atan2(in.x * out.y - in.y * out.x, in.x * out.x + in.y * out.y));
}

}  // namespace

std::vector<DxfChain> chainsOf(const std::vector<DxfEntity>& entities, const std::string& layer, double metres) {
  std::vector<DxfChain> out;
  for (const DxfEntity& e : entities) {
    if (e.layer != layer) continue;
    DxfChain c;
    if (e.kind == DxfEntity::Kind::circle && e.size > 0) {
      const Vec2 at = e.points.front();
      c.points = {{metres * (at.x - e.size), metres * at.y}, {metres * (at.x + e.size), metres * at.y}};
      c.bulges = {1, 1};
      c.closed = true;
    } else if (e.kind == DxfEntity::Kind::polyline && e.points.size() > 1) {
      for (const Vec2& p : e.points) c.points.push_back({metres * p.x, metres * p.y});
      c.bulges = e.bulges;
      c.closed = e.closed;
      tidy(c);
    }
    if (c.points.size() > 1) out.push_back(std::move(c));
  }
  join(out);
  return out;
}

double gapOf(const DxfChain& chain) { return chain.closed ? 0 : distance(chain.points.front(), chain.points.back()); }

PanelLoop loopOf(const DxfChain& chain, const std::vector<Vec2>& turns, bool& guessed) {
  const std::size_t n = chain.points.size();
  std::vector<Vec2> sorted = turns;
  std::sort(sorted.begin(), sorted.end(), [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<bool> corner(n);
  bool any = false;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 p = chain.points[k];
    auto near = std::lower_bound(sorted.begin(), sorted.end(), p.x - kTurn_m, [](Vec2 a, double x) { return a.x < x; });
    for (; near != sorted.end() && near->x <= p.x + kTurn_m && !corner[k]; ++near)
      corner[k] = distance(*near, p) <= kTurn_m;
    any = any || corner[k];
  }
  guessed = !any;
  for (std::size_t k = 0; k < n; ++k) {
    if (!any && angleAt(chain, k) > kCorner_rad) corner[k] = true;
    if (chain.bulges[k] != 0) corner[k] = corner[(k + 1) % n] = true;
  }
  std::size_t first = 0;
  while (first < n && !corner[first]) ++first;
  if (first == n) corner[first = 0] = true;
  PanelLoop loop;
  for (std::size_t i = 0; i < n;) {
    const std::size_t at = (first + i) % n;
    PanelEdge edge{"", chain.points[at], StraightEdge{}};
    PolylineEdge inner;
    for (++i; i < n && !corner[(first + i) % n]; ++i) inner.points_m.push_back(chain.points[(first + i) % n]);
    if (chain.bulges[at] != 0)
      edge.curve = ArcEdge{4 * std::atan(chain.bulges[at])};
    else if (!inner.points_m.empty())
      edge.curve = std::move(inner);
    loop.push_back(std::move(edge));
  }
  return loop;
}

}  // namespace gambeson
