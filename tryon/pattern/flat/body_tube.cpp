#include "tryon/pattern/flat/body_tube.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gambeson {
namespace {

std::vector<Vec2> grown(const std::vector<Vec2>& hull, double off_m) {
  constexpr int kAround = 96;
  std::vector<Vec2> out;
  for (const Vec2& p : hull)
    for (int k = 0; k < kAround; ++k) {
      const double a = 2 * std::numbers::pi * k / kAround;
      out.push_back({p.x + off_m * std::cos(a), p.y + off_m * std::sin(a)});
    }
  return convexHull(std::move(out));
}

}  // namespace

BodyTube::BodyTube(const std::vector<Vec2>& hull, double off_m) : curve_(grown(hull, off_m)) {
  Vec2 right = hull.front(), left = hull.front();
  for (const Vec2& p : hull) {
    if (p.y < right.y) right = p;
    if (p.y > left.y) left = p;
  }
  centre_ = {0.5 * (left.x + right.x), 0.5 * (left.y + right.y)};
}

Vec2 BodyTube::tangent(double s) const {
  constexpr double h = 0.003;
  const Vec2 a = curve_.point(s - h), b = curve_.point(s + h);
  const double l = std::hypot(b.x - a.x, b.y - a.y);
  return {(b.x - a.x) / l, (b.y - a.y) / l};
}

TubeHalf BodyTube::half(bool front, double from, double to, double gap_m) const {
  constexpr double kStep_m = 0.002;
  const double sense = front ? 1 : -1;
  TubeHalf out{curve_.crossing(centre_, {sense, 0}), 0, 0};
  const auto reach = [&](double way, double span) {
    // The furthest bend up to which no other one is too far, and that leaves its end on its side.
    double bend = 0;
    for (double b = 0; b < 0.5 * curve_.length(); b += kStep_m) {
      const double on = std::min(b, span);
      const Vec2 p = curve_.point(out.middle + way * on), t = tangent(out.middle + way * on);
      const double x = p.x + way * (span - on) * t.x;
      if (!(sense * (x - centre_.x) >= 0.5 * gap_m) || !(sense * (p.x - centre_.x) >= 0.5 * gap_m)) break;
      bend = on;
      if (b >= span) break;
    }
    return bend;
  };
  out.to = reach(1, to);
  out.from = -reach(-1, -from);
  return out;
}

Vec2 BodyTube::at(const TubeHalf& half, double s) const {
  const double on = std::clamp(s, half.from, half.to);
  const Vec2 p = curve_.point(half.middle + on);
  if (s == on) return p;
  const Vec2 t = tangent(half.middle + on);
  return {p.x + (s - on) * t.x, p.y + (s - on) * t.y};
}

}  // namespace gambeson
