#include "cases/structure/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "cases/cloth/arc.hpp"

namespace gambeson {
namespace {

const KnotVector straight{1, {0, 0, 1, 1}};
const KnotVector arc_knots{2, {0, 0, 0, 1, 1, 1}};

/// Control points (cos, sin) of a unit arc, the middle one outside the circle; weights 1, cos(angle/2), 1.
struct Arc {
  std::array<Vec2, 3> points;
  std::array<double, 3> weights;
};

Arc unitArc(double start, double end) {
  const double half = (end - start) / 2, middle = (start + end) / 2, w = std::cos(half);
  return {{Vec2{std::cos(start), std::sin(start)}, Vec2{std::cos(middle) / w, std::sin(middle) / w},
           Vec2{std::cos(end), std::sin(end)}},
          {1, w, 1}};
}

/// Piece k of n of an arc. A closed arc ends on the bits where it starts.
Arc pieceOf(double start, double end, int k, int n, bool closed) {
  const auto at = [&](int i) { return closed && i == n ? start : start + (end - start) * i / n; };
  Arc arc = unitArc(start + (end - start) * k / n, start + (end - start) * (k + 1) / n);
  arc.points[0] = {std::cos(at(k)), std::sin(at(k))};
  arc.points[2] = {std::cos(at(k + 1)), std::sin(at(k + 1))};
  return arc;
}

}  // namespace

int arcPieces(double angle_rad, int cells) {
  const int least = std::max(1, static_cast<int>(std::ceil(angle_rad / (std::numbers::pi / 2) - 1e-9)));
  for (int n = least; n <= cells; ++n)
    if (cells % n == 0) return n;
  return 0;
}

NurbsPatch platePatch(const PlateShape& s) {
  NurbsPatch p{straight, straight, {}, {1, 1, 1, 1}};
  for (const double v : {0., 1.})
    for (const double u : {0., 1.}) p.points.push_back(s.corner + u * s.width_m * s.axis_u + v * s.height_m * s.axis_v);
  return p;
}

NurbsPatch cylinderPatch(const CylinderShape& s, const Grid& grid, int i) {
  const Arc arc = pieceOf(s.start_angle_rad, s.end_angle_rad, i, grid.count_u, grid.closed_u);
  const Vec3 side = cross(s.axis, s.zero);
  NurbsPatch p{arc_knots, straight, {}, {}};
  for (const double v : {0., 1.})
    for (std::size_t k = 0; k < 3; ++k) {
      p.points.push_back(s.start + s.radius_m * (arc.points[k].x * s.zero + arc.points[k].y * side) +
                         v * s.length_m * s.axis);
      p.weights.push_back(arc.weights[k]);
    }
  return p;
}

NurbsPatch spherePatch(const SphereShape& s, const Grid& grid, int i, int j) {
  const Arc around = pieceOf(s.longitude_start_rad, s.longitude_end_rad, i, grid.count_u, grid.closed_u);
  const Arc profile = pieceOf(s.latitude_start_rad, s.latitude_end_rad, j, grid.count_v, false);
  const Vec3 side = cross(s.axis, s.zero);
  NurbsPatch p{arc_knots, arc_knots, {}, {}};
  for (std::size_t b = 0; b < 3; ++b)
    for (std::size_t a = 0; a < 3; ++a) {
      const Vec3 out = around.points[a].x * s.zero + around.points[a].y * side;
      p.points.push_back(s.center + s.radius_m * (profile.points[b].x * out + profile.points[b].y * s.axis));
      p.weights.push_back(around.weights[a] * profile.weights[b]);
    }
  return p;
}

NurbsPatch annulusPatch(const AnnulusShape& s, const Grid& grid, int j) {
  const Arc arc = pieceOf(s.start_angle_rad, s.end_angle_rad, j, grid.count_v, grid.closed_v);
  const Vec3 side = cross(s.normal, s.zero);
  NurbsPatch p{straight, arc_knots, {}, {}};
  for (std::size_t k = 0; k < 3; ++k)
    for (const double radius : {s.inner_radius_m, s.outer_radius_m}) {
      p.points.push_back(s.center + radius * (arc.points[k].x * s.zero + arc.points[k].y * side));
      p.weights.push_back(arc.weights[k]);
    }
  return p;
}

double turningArea(const std::vector<NurbsCurve>& loop) {
  constexpr int steps = 64;  // only the sign matters
  std::vector<Vec2> outline;
  for (const NurbsCurve& c : loop)
    for (int i = 0; i < steps; ++i)
      outline.push_back(curvePoint(c, c.knots.front() + (c.knots.back() - c.knots.front()) * i / steps).point);
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    area += a.x * b.y - a.y * b.x;
  }
  return area;
}

}  // namespace gambeson
