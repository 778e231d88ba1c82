/// Detail of dxf_piece.hpp: pieces that stand in no block.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/pattern/dxf_loops.hpp"
#include "cases/pattern/dxf_piece.hpp"

namespace gambeson {
namespace {

constexpr std::size_t kMostPieces = 2000;

/// A closed line as a polygon, arcs in pieces.
std::vector<Vec2> polygonOf(const DxfChain& c) {
  std::vector<Vec2> out;
  for (std::size_t k = 0; k < c.points.size(); ++k) {
    const Vec2 a = c.points[k], b = c.points[(k + 1) % c.points.size()];
    out.push_back(a);
    const double half = 2 * std::atan(c.bulges[k]);  // of the angle of the arc
    if (c.bulges[k] == 0 || !(std::abs(std::sin(half)) > 1e-9)) continue;
    const Vec2 mid{0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
    const double off = 0.5 / std::tan(half);
    const Vec2 center{mid.x - off * (b.y - a.y), mid.y + off * (b.x - a.x)};
    for (int i = 1; i < 16; ++i) {
      const double s = std::sin(2 * half * i / 16), co = std::cos(2 * half * i / 16);
      const Vec2 r{a.x - center.x, a.y - center.y};
      out.push_back({center.x + co * r.x - s * r.y, center.y + s * r.x + co * r.y});
    }
  }
  return out;
}

bool isWithin(const std::vector<Vec2>& polygon, Vec2 p) {
  bool inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

double distance(const std::vector<Vec2>& polygon, Vec2 p) {
  double best = 1e300;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 a = polygon[k], b = polygon[(k + 1) % polygon.size()], d{b.x - a.x, b.y - a.y};
    const double d2 = d.x * d.x + d.y * d.y;
    const double t = d2 > 0 ? std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / d2, 0.0, 1.0) : 0;
    best = std::min(best, std::hypot(p.x - a.x - t * d.x, p.y - a.y - t * d.y));
  }
  return best;
}

}  // namespace

std::vector<DxfBlock> loosePieces(const std::vector<DxfEntity>& entities, double metres, DxfCounts& dropped) {
  constexpr double on_m = 1e-3;
  std::vector<std::vector<Vec2>> all, outer;
  for (const DxfChain& c : chainsOf(entities, "1", metres))
    if (c.closed && all.size() < kMostPieces) all.push_back(polygonOf(c));
  for (std::size_t k = 0; k < all.size(); ++k) {
    bool within = false;
    for (std::size_t i = 0; i < all.size() && !within; ++i) within = i != k && isWithin(all[i], all[k].front());
    if (!within) outer.push_back(all[k]);
  }
  std::vector<DxfBlock> out(outer.size());
  for (std::size_t k = 0; k < outer.size(); ++k) out[k].name = fmt::format("piece_{}", k + 1);
  for (const DxfEntity& e : entities) {
    if (e.points.empty() || e.kind == DxfEntity::Kind::insert) continue;
    const Vec2 p{metres * e.points.front().x, metres * e.points.front().y};
    const auto of = std::find_if(outer.begin(), outer.end(), [&](const std::vector<Vec2>& polygon) {
      return isWithin(polygon, p) || distance(polygon, p) <= on_m;
    });
    if (of != outer.end())
      out[static_cast<std::size_t>(of - outer.begin())].entities.push_back(e);
    else if (e.kind != DxfEntity::Kind::text)
      dropped.add(fmt::format("a {} of layer {} that lies in no closed line of layer 1", e.type, e.layer));
    else if (!systemText(e))
      dropped.add("a text that lies in no closed line of layer 1");
  }
  return out;
}

}  // namespace gambeson
