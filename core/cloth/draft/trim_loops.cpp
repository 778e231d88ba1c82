#include "core/cloth/draft/trim_loops.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {

/// Twice the signed area of a closed polygon.
double turn(std::span<const Vec2> p) {
  double sum = 0;
  for (std::size_t k = 0; k < p.size(); ++k) {
    const Vec2 a = p[k], b = p[(k + 1) % p.size()];
    sum += a.x * b.y - b.x * a.y;
  }
  return sum;
}

/// The points in the order that keeps the asked side to the left.
std::vector<Vec2> ordered(std::span<const Vec2> points_m, Keep keep) {
  std::vector<Vec2> out(points_m.begin(), points_m.end());
  if ((turn(out) > 0) != (keep == Keep::inside)) std::reverse(out.begin(), out.end());
  return out;
}

}  // namespace

FlatRectangle flatRectangle(const NurbsPatch& patch) {
  validate(patch);
  const auto gu = grevillePoints(patch.u), gv = grevillePoints(patch.v);
  const int nu = patch.u.count(), nv = patch.v.count();
  const Vec3 corner = patch.points[0], along_u = patch.points[patch.index(nu - 1, 0)] - corner,
             along_v = patch.points[patch.index(0, nv - 1)] - corner;
  FlatRectangle r;
  r.length_m = {norm(along_u), norm(along_v)};
  r.origin = {patch.u.front(), patch.v.front()};
  r.range = {patch.u.back() - patch.u.front(), patch.v.back() - patch.v.front()};
  const double size = std::max(r.length_m.x, r.length_m.y);
  bool even = r.length_m.x > 0 && r.length_m.y > 0 && gu.front() == patch.u.front() && gu.back() == patch.u.back() &&
              gv.front() == patch.v.front() && gv.back() == patch.v.back() &&
              std::abs(dot(along_u, along_v)) <= 1e-9 * r.length_m.x * r.length_m.y;
  for (int j = 0; j < nv && even; ++j)
    for (int i = 0; i < nu && even; ++i) {
      const double a = (gu[i] - gu.front()) / r.range.x, b = (gv[j] - gv.front()) / r.range.y;
      even = norm(patch.points[patch.index(i, j)] - (corner + a * along_u + b * along_v)) <= 1e-9 * size &&
             patch.weights[patch.index(i, j)] == patch.weights[0];
    }
  if (!even)
    throw InputError(
        {"", 0, "patch"},
        "loops in lengths need a flat rectangle with even parameters; give the loop in parameters instead");
  return r;
}

TrimLoop circleLoop(const NurbsPatch& patch, Vec2 center_m, double radius_m, Keep keep) {
  if (!(radius_m > 0)) throw InputError({"", 0, "radius_m"}, std::to_string(radius_m) + ", must be > 0");
  const FlatRectangle r = flatRectangle(patch);
  return {circle(r.parameters(center_m), radius_m / r.length_m.x * r.range.x, radius_m / r.length_m.y * r.range.y,
                 keep == Keep::outside)};
}

TrimLoop polygonLoop(const NurbsPatch& patch, std::span<const Vec2> corners_m, Keep keep) {
  const FlatRectangle r = flatRectangle(patch);
  std::vector<Vec2> corners = ordered(corners_m, keep);
  for (Vec2& p : corners) p = r.parameters(p);
  return polygon(corners);
}

// Chord lengths in metres; the map to parameters is affine, so that the control points carry it.
TrimLoop splineLoop(const NurbsPatch& patch, std::span<const Vec2> points_m, Keep keep) {
  const FlatRectangle r = flatRectangle(patch);
  NurbsCurve curve = closedSpline(ordered(points_m, keep));
  for (Vec2& p : curve.points) p = r.parameters(p);
  return {curve};
}

}  // namespace gambeson
