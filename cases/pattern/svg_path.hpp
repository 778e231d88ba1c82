#pragma once
/// Detail of svg.hpp: shapes as SVG has them.

#include <string>
#include <string_view>
#include <vector>

#include "tryon/pattern/flat/panel.hpp"

namespace gambeson::svg {

/// From m in a panel's plane to mm on the page, whose y points down.
struct Frame {
  Vec2 low_m;            ///< of the panel
  double top_m = 0;      ///< its largest y
  Vec2 corner_mm{0, 0};  ///< where its box starts on the page

  Vec2 at(Vec2 p) const { return {corner_mm.x + 1000 * (p.x - low_m.x), corner_mm.y + 1000 * (top_m - p.y)}; }
};

/// "M 12.345 6.78": a command and where it leads, to a micrometre.
std::string to(std::string_view command, Vec2 mm);
std::string number(double x);
std::string escaped(std::string_view text);

/// What follows "M x y" on the way along an edge, its end included: lines, Beziers and arcs as they are, other splines
/// as lines within 0.01 mm.
std::string along(const Frame& frame, const PanelEdge& edge, Vec2 end);
std::string closedPath(const Frame& frame, const PanelLoop& loop);
std::string polyline(const Frame& frame, const std::vector<Vec2>& points, bool closed);

/// A point well inside of a panel, and how far it is from the nearest edge [m].
struct Inside {
  Vec2 point;
  double room_m = 0;
};
Inside insideOf(const Panel& panel);

/// Colour of the k-th of many things, neighbours far apart.
std::string colour(std::size_t k);

}  // namespace gambeson::svg
