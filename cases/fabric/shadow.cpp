#include "cases/fabric/shadow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gambeson::laboratory {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

using Interval = std::array<double, 2>;

/// Where a ray lies in a triangle of the plane, outside the support; an empty one where it does not.
Interval inside(const std::array<Vec2, 3>& corner, Vec2 ray, double support) {
  std::array<double, 3> along, beside;
  for (std::size_t k = 0; k < 3; ++k) {
    along[k] = ray.x * corner[k].x + ray.y * corner[k].y;
    beside[k] = ray.x * corner[k].y - ray.y * corner[k].x;
  }
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    if ((beside[a] > 0) == (beside[b] > 0)) continue;
    const double at = along[a] + (along[b] - along[a]) * beside[a] / (beside[a] - beside[b]);
    low = std::min(low, at), high = std::max(high, at);
  }
  return {std::max(low, support), high};
}

/// The rays that a triangle may meet: first and last, counted on beyond a turn.
std::array<int, 2> raysOf(const std::array<Vec2, 3>& corner, int rays) {
  const double first = std::atan2(corner[0].y, corner[0].x);
  double low = first, high = first;
  for (const Vec2& x : {corner[1], corner[2]}) {
    const double angle = first + std::remainder(std::atan2(x.y, x.x) - first, kTurn);
    low = std::min(low, angle), high = std::max(high, angle);
  }
  const double step = kTurn / rays;
  return {static_cast<int>(std::floor(low / step - 0.5)), static_cast<int>(std::ceil(high / step - 0.5))};
}

}  // namespace

Vec2 rayAt(int k, int rays) {
  const double angle = kTurn * (k + 0.5) / rays;
  return {std::cos(angle), std::sin(angle)};
}

Shadow shadowOf(std::span<const Vec3> points, std::span<const std::array<int, 3>> triangles, double support_m,
                int rays) {
  std::vector<std::vector<Interval>> covered(static_cast<std::size_t>(rays));
  for (const std::array<int, 3>& t : triangles) {
    std::array<Vec2, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& x = points[static_cast<std::size_t>(t[k])];
      corner[k] = {x.x, x.y};
    }
    const auto [first, last] = raysOf(corner, rays);
    for (int k = first; k <= last; ++k) {
      const int ray = (k % rays + rays) % rays;
      const Interval i = inside(corner, rayAt(ray, rays), support_m);
      if (i[1] > i[0]) covered[static_cast<std::size_t>(ray)].push_back(i);
    }
  }
  Shadow shadow;
  for (std::vector<Interval>& on_ray : covered) {
    std::sort(on_ray.begin(), on_ray.end());
    double reach = support_m;
    for (const auto& [low, high] : on_ray) {
      const double from = std::max(low, reach);
      if (!(high > from)) continue;
      shadow.area_m2 += 0.5 * (high * high - from * from) * kTurn / rays;
      reach = high;
    }
    shadow.reach_m.push_back(reach);
  }
  return shadow;
}

int nodesOf(std::span<const double> reach, double least_m) {
  if (reach.empty()) return 0;
  const std::size_t start = static_cast<std::size_t>(std::min_element(reach.begin(), reach.end()) - reach.begin());
  int nodes = 0;
  bool up = false;  // on the way from a hollow
  double extreme = reach[start];
  for (std::size_t k = 1; k <= reach.size(); ++k) {
    const double r = reach[(start + k) % reach.size()];
    if (!up && r > extreme + least_m) {
      up = true, extreme = r;
    } else if (up && r < extreme - least_m) {
      up = false, extreme = r, ++nodes;
    } else {
      extreme = up ? std::max(extreme, r) : std::min(extreme, r);
    }
  }
  return nodes;
}

}  // namespace gambeson::laboratory
