#include "tryon/pattern/wrap.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace gambeson {
namespace {

double turn(const Vec2& o, const Vec2& a, const Vec2& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

}  // namespace

Wrap::Wrap(const std::vector<std::vector<Vec2>>& cross_sections, double from, double to) : from_(from), to_(to) {
  assert(cross_sections.size() >= 2);
  const int n = static_cast<int>(cross_sections.size());
  support_.assign(n, std::vector<double>(directions));
  std::vector<int> chain;
  for (int d = 0; d < directions; ++d) {
    const double angle = 2 * std::numbers::pi * d / directions, c = std::cos(angle), s = std::sin(angle);
    for (int k = 0; k < n; ++k) {
      double h = -HUGE_VAL;
      for (const Vec2& p : cross_sections[k]) h = std::max(h, c * p.x + s * p.y);
      support_[k][d] = h;
    }
    chain.clear();  // the heights where the concave envelope touches
    for (int k = 0; k < n; ++k) {
      const auto height = [&](int i) { return Vec2{static_cast<double>(i), support_[i][d]}; };
      while (chain.size() >= 2 && turn(height(chain[chain.size() - 2]), height(chain.back()), height(k)) >= 0)
        chain.pop_back();
      chain.push_back(k);
    }
    for (std::size_t i = 1; i < chain.size(); ++i)
      for (int k = chain[i - 1] + 1; k < chain[i]; ++k) {
        const double t = static_cast<double>(k - chain[i - 1]) / (chain[i] - chain[i - 1]);
        support_[k][d] = (1 - t) * support_[chain[i - 1]][d] + t * support_[chain[i]][d];
      }
  }
}

namespace {
Vec2 directionOf(int d, int directions) {
  const double angle = 2 * std::numbers::pi * d / directions;
  return {std::cos(angle), std::sin(angle)};
}
double supportOf(const std::vector<Vec2>& points, const Vec2& n) {
  double h = -HUGE_VAL;
  for (const Vec2& p : points) h = std::max(h, n.x * p.x + n.y * p.y);
  return h;
}
}  // namespace

Wrap Wrap::plain(const std::vector<std::vector<Vec2>>& cross_sections, double from, double to) {
  Wrap out;
  out.from_ = from, out.to_ = to;
  for (const auto& points : cross_sections) {
    out.support_.emplace_back(directions);
    for (int d = 0; d < directions; ++d) out.support_.back()[d] = supportOf(points, directionOf(d, directions));
  }
  return out;
}

template <class F>
Wrap Wrap::changed(const F& support) const {
  Wrap out = *this;
  for (int k = 0; k < heights(); ++k)
    for (int d = 0; d < directions; ++d) out.support_[k][d] = support(k, d);
  return out;
}

Wrap Wrap::grown(double factor, const Vec2& c) const {
  return changed([&](int k, int d) {
    const Vec2 n = directionOf(d, directions);
    const double middle = n.x * c.x + n.y * c.y;
    return middle + factor * (support_[k][d] - middle);
  });
}

Wrap Wrap::offset(double distance) const {
  return changed([&](int k, int d) { return support_[k][d] + distance; });
}

Wrap Wrap::raised(const std::function<double(double)>& distance) const {
  return changed([&](int k, int d) { return support_[k][d] + distance(heightOf(k)); });
}

Wrap Wrap::with(const Wrap& other) const {
  assert(other.heights() == heights() && other.from_ == from_ && other.to_ == to_);
  return changed([&](int k, int d) { return std::max(support_[k][d], other.support_[k][d]); });
}

Wrap Wrap::widened(double reach) const {
  const int n = static_cast<int>(std::ceil(reach * (heights() - 1) / (to_ - from_)));
  return changed([&](int k, int d) {
    double h = -HUGE_VAL;
    for (int i = std::max(0, k - n); i <= std::min(heights() - 1, k + n); ++i) h = std::max(h, support_[i][d]);
    return h;
  });
}

Wrap Wrap::blended(const std::vector<Vec2>& other, const std::function<double(double)>& share) const {
  return changed([&](int k, int d) {
    const double w = share(heightOf(k));
    return (1 - w) * support_[k][d] + w * supportOf(other, directionOf(d, directions));
  });
}

double Wrap::girth(double z) const { return ClosedCurve(crossSection(z)).length(); }

double Wrap::beyond(double z, const Vec2& point) const {
  static const std::vector<Vec2> normals = [] {
    std::vector<Vec2> out;
    for (int d = 0; d < directions; ++d) out.push_back(directionOf(d, directions));
    return out;
  }();
  const int n = heights();
  const double at = std::clamp((z - from_) / (to_ - from_), 0.0, 1.0) * (n - 1);
  const int k = std::min(static_cast<int>(at), n - 2);
  const double t = at - k;
  double most = -HUGE_VAL;
  for (int d = 0; d < directions; ++d) {
    const double h = (1 - t) * support_[k][d] + t * support_[k + 1][d];
    most = std::max(most, normals[d].x * point.x + normals[d].y * point.y - h);
  }
  return most;
}

std::vector<Vec2> Wrap::crossSection(double z) const {
  const int n = static_cast<int>(support_.size());
  const double at = std::clamp((z - from_) / (to_ - from_), 0.0, 1.0) * (n - 1);
  const int k = std::min(static_cast<int>(at), n - 2);
  const double t = at - k;
  const auto h = [&](int d) { return (1 - t) * support_[k][d % directions] + t * support_[k + 1][d % directions]; };
  const double step = 2 * std::numbers::pi / directions;
  std::vector<Vec2> out;
  for (int d = 0; d < directions; ++d) {
    // Where the tangents d and d + 1 cross: h along the normal and, along the tangent, (h' - h cos) / sin.
    const double along = (h(d + 1) - h(d) * std::cos(step)) / std::sin(step);
    const double c = std::cos(d * step), s = std::sin(d * step);
    out.push_back({c * h(d) - s * along, s * h(d) + c * along});
  }
  return out;
}

ClosedCurve::ClosedCurve(std::vector<Vec2> points) : points_(std::move(points)) {
  assert(points_.size() >= 3);
  points_.push_back(points_.front());
  at_.push_back(0);
  for (std::size_t i = 1; i < points_.size(); ++i)
    at_.push_back(at_.back() + std::hypot(points_[i].x - points_[i - 1].x, points_[i].y - points_[i - 1].y));
}

Vec2 ClosedCurve::point(double s) const {
  s -= length() * std::floor(s / length());
  const auto it = std::upper_bound(at_.begin() + 1, at_.end() - 1, s);
  const std::size_t i = it - at_.begin();
  const double way = at_[i] - at_[i - 1];  // none where growing made two points one
  const double t = way > 0 ? (s - at_[i - 1]) / way : 0;
  return {points_[i - 1].x + t * (points_[i].x - points_[i - 1].x),
          points_[i - 1].y + t * (points_[i].y - points_[i - 1].y)};
}

double ClosedCurve::crossing(const Vec2& origin, const Vec2& direction) const {
  const auto side = [&](const Vec2& p) { return direction.x * (p.y - origin.y) - direction.y * (p.x - origin.x); };
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double a = side(points_[i - 1]), b = side(points_[i]);
    if (!(a < 0 && b >= 0)) continue;
    // Where tangents meet in a corner the polygon can step back by rounding, also opposite the ray.
    const double t = a / (a - b);
    const Vec2 x{points_[i - 1].x + t * (points_[i].x - points_[i - 1].x),
                 points_[i - 1].y + t * (points_[i].y - points_[i - 1].y)};
    if (direction.x * (x.x - origin.x) + direction.y * (x.y - origin.y) > 0)
      return at_[i - 1] + t * (at_[i] - at_[i - 1]);
  }
  return 0;  // only for an origin outside
}

Vec2 ClosedCurve::centroid() const {
  const Vec2 o = points_.front();
  double area = 0, x = 0, y = 0;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double w = turn(o, points_[i - 1], points_[i]);
    area += w;
    x += w * (points_[i - 1].x + points_[i].x - 2 * o.x) / 3;
    y += w * (points_[i - 1].y + points_[i].y - 2 * o.y) / 3;
  }
  return {o.x + x / area, o.y + y / area};
}

double ClosedCurve::extent(const Vec2& direction) const { return supportOf(points_, direction); }

ClosedCurve ClosedCurve::grown(double factor, const Vec2& centre) const {
  std::vector<Vec2> out(points_.begin(), points_.end() - 1);
  for (Vec2& p : out) p = {centre.x + factor * (p.x - centre.x), centre.y + factor * (p.y - centre.y)};
  return ClosedCurve(std::move(out));
}

}  // namespace gambeson
