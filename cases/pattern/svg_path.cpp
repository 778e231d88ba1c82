#include "cases/pattern/svg_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tryon/pattern/flat/crossings.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson::svg {

std::string number(double x) {
  std::string s = fmt::format("{:.3f}", x);
  while (s.ends_with('0')) s.pop_back();
  if (s.ends_with('.')) s.pop_back();
  return s == "-0" ? "0" : s;
}
std::string to(std::string_view command, Vec2 mm) {
  return fmt::format("{}{} {}", command, number(mm.x), number(mm.y));
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

namespace {

struct Along {
  const Frame& frame;
  const PanelEdge& edge;
  Vec2 end;
  std::string line() const { return to(" L ", frame.at(end)); }
  std::string operator()(const StraightEdge&) const { return line(); }
  std::string operator()(const BezierEdge& e) const {
    std::string s = e.controls_m.size() == 1 ? " Q" : " C";
    for (const Vec2& c : e.controls_m) s += to(" ", frame.at(c));
    return s + to(" ", frame.at(end));
  }
  std::string operator()(const ArcEdge& e) const {
    const Vec2 a = edge.start_m;
    const double r = 500 * std::hypot(end.x - a.x, end.y - a.y) / std::sin(0.5 * std::abs(e.turn_rad));
    // A turn to the left is counter-clockwise on the page too: its y points down, and so angles grow clockwise.
    return fmt::format(" A {0} {0} 0 {1} {2} {3}", number(r), std::abs(e.turn_rad) > std::numbers::pi ? 1 : 0,
                       e.turn_rad > 0 ? 0 : 1, to("", frame.at(end)));
  }
  std::string operator()(const SplineEdge&) const {
    std::string s;
    std::vector<Vec2> points = flattened(edge, end, 1e-5);
    for (std::size_t k = 1; k < points.size(); ++k) s += to(" L ", frame.at(points[k]));
    return s + line();
  }
  std::string operator()(const PolylineEdge& e) const {
    std::string s;
    for (const Vec2& p : e.points_m) s += to(" L ", frame.at(p));
    return s + line();
  }
};

}  // namespace

std::string along(const Frame& frame, const PanelEdge& edge, Vec2 end) {
  return std::visit(Along{frame, edge, end}, edge.curve);
}

std::string closedPath(const Frame& frame, const PanelLoop& loop) {
  std::string s = to("M ", frame.at(loop.front().start_m));
  for (std::size_t k = 0; k < loop.size(); ++k) s += along(frame, loop[k], loop[(k + 1) % loop.size()].start_m);
  return s + " Z";
}

std::string polyline(const Frame& frame, const std::vector<Vec2>& points, bool closed) {
  std::string s;
  for (std::size_t k = 0; k < points.size(); ++k) s += to(k == 0 ? "M " : " L ", frame.at(points[k]));
  return closed ? s + " Z" : s;
}

Inside insideOf(const Panel& panel) {
  const PanelBox box = boxOf(panel.outline);
  std::vector<std::vector<Vec2>> loops{flattened(panel.outline, 2e-3)};
  for (const PanelLoop& c : panel.cutouts) loops.push_back(flattened(c, 2e-3));
  const auto room = [&](Vec2 p) {
    double nearest = 1e300;
    int winding = 0;
    for (const auto& loop : loops) {
      winding += windingOf(loop, p);
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vec2 a = loop[k], b = loop[(k + 1) % loop.size()], d{b.x - a.x, b.y - a.y};
        const double d2 = d.x * d.x + d.y * d.y;
        const double t = d2 > 0 ? std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / d2, 0.0, 1.0) : 0;
        nearest = std::min(nearest, std::hypot(p.x - a.x - t * d.x, p.y - a.y - t * d.y));
      }
    }
    return winding > 0 ? nearest : -nearest;
  };
  constexpr int grid = 21;
  Inside best{{0.5 * (box.low.x + box.high.x), 0.5 * (box.low.y + box.high.y)}, -1};
  best.room_m = room(best.point);
  for (int i = 1; i < grid; ++i)
    for (int j = 1; j < grid; ++j) {
      const Vec2 p{box.low.x + (box.high.x - box.low.x) * i / grid, box.low.y + (box.high.y - box.low.y) * j / grid};
      if (const double r = room(p); r > best.room_m) best = {p, r};
    }
  return best;
}

std::string colour(std::size_t k) {
  // Hues by the golden angle; lightness in turns, so that hues that come near again differ by it.
  constexpr std::array<int, 3> light{40, 52, 32};
  return fmt::format("hsl({}, 70%, {}%)", static_cast<int>(std::fmod(18 + 137.508 * static_cast<double>(k), 360)),
                     light[k % 3]);
}

}  // namespace gambeson::svg
