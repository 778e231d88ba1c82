#include "tryon/pattern/flat/turn_panel.hpp"

#include <algorithm>

namespace gambeson {
namespace {

void flip(Vec2& p) { p.x = -p.x; }
void flip(std::vector<Vec2>& points) {
  for (Vec2& p : points) flip(p);
}

struct Mirror {
  void operator()(StraightEdge&) const {}
  void operator()(BezierEdge& e) const { flip(e.controls_m); }
  void operator()(ArcEdge& e) const { e.turn_rad = -e.turn_rad; }
  void operator()(SplineEdge& e) const { flip(e.controls_m); }
  void operator()(PolylineEdge& e) const { flip(e.points_m); }
};
void flip(PanelLoop& loop) {
  for (PanelEdge& e : loop) {
    flip(e.start_m);
    std::visit(Mirror{}, e.curve);
  }
}

struct Reverse {
  void operator()(StraightEdge&) const {}
  void operator()(BezierEdge& e) const { std::reverse(e.controls_m.begin(), e.controls_m.end()); }
  void operator()(ArcEdge& e) const { e.turn_rad = -e.turn_rad; }
  void operator()(SplineEdge& e) const {
    std::reverse(e.controls_m.begin(), e.controls_m.end());
    std::reverse(e.weights.begin(), e.weights.end());
    std::reverse(e.knots.begin(), e.knots.end());
    const double ends = e.knots.empty() ? 0 : e.knots.front() + e.knots.back();
    for (double& k : e.knots) k = ends - k;
  }
  void operator()(PolylineEdge& e) const { std::reverse(e.points_m.begin(), e.points_m.end()); }
};

}  // namespace

PanelLoop reversed(const PanelLoop& loop) {
  PanelLoop out(loop.rbegin(), loop.rend());
  for (std::size_t k = 0; k < loop.size(); ++k) {
    out[k].start_m = loop[(loop.size() - k) % loop.size()].start_m;
    std::visit(Reverse{}, out[k].curve);
  }
  return out;
}

void mirror(Panel& panel) {
  flip(panel.outline);
  for (PanelLoop& c : panel.cutouts) flip(c);
  flip(panel.cut_line);
  if (panel.grain) {
    flip(panel.grain->from_m);
    flip(panel.grain->to_m);
  }
  for (InternalLine& l : panel.lines) flip(l.points_m);
  for (Annotation& a : panel.annotations) flip(a.at_m);
  if (panel.placement) panel.placement->along_x = -panel.placement->along_x;
}

}  // namespace gambeson
