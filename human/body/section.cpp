#include "human/body/section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace gambeson {
namespace {

double turn(const Vec2& o, const Vec2& a, const Vec2& b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

// x = c + R diag(a) w with |w| = 1: the plane z = height is m . w = height - c.z, m = diag(a) Rᵀ e_z, a circle on the
// sphere.
std::vector<Vec2> crossSection(const Ellipsoid& e, const Placement& X, double height) {
  const Vec3 a = X.scale * e.semi_axes, up = transposeTimes(X.rotation, {0, 0, 1});
  const Vec3 m{a.x * up.x, a.y * up.y, a.z * up.z};
  const double d = (height - X.origin.z) / norm(m);
  if (!(std::abs(d) < 1)) return {};
  const Vec3 k = normalized(m);
  const Vec3 i = normalized(cross(std::abs(k.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, k)), j = cross(k, i);
  const double r = std::sqrt(1 - d * d);
  constexpr int n = 720;
  std::vector<Vec2> out;
  for (int t = 0; t < n; ++t) {
    const double angle = 2 * std::numbers::pi * t / n;
    const Vec3 w = d * k + r * (std::cos(angle) * i + std::sin(angle) * j);
    const Vec3 x = X.rotation * Vec3{a.x * w.x, a.y * w.y, a.z * w.z} + X.origin;
    out.push_back({x.x, x.y});
  }
  return out;
}

std::vector<Vec2> crossSection(const TriangleMesh& mesh, const Placement& X, double height) {
  std::vector<Vec2> out;
  for (const auto& triangle : mesh.triangles)
    for (int e = 0; e < 3; ++e) {
      const Vec3 a = X * mesh.vertices[triangle[e]], b = X * mesh.vertices[triangle[(e + 1) % 3]];
      if ((a.z < height) == (b.z < height)) continue;
      const double t = (height - a.z) / (b.z - a.z);
      out.push_back({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)});
    }
  return out;
}

}  // namespace

std::vector<Vec2> crossSection(const Shape& shape, const Placement& placement, double height) {
  return std::visit([&](const auto& s) { return crossSection(s, placement, height); }, shape);
}

std::vector<Vec2> convexHull(std::vector<Vec2> p) {
  std::sort(p.begin(), p.end(), [](const Vec2& a, const Vec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  std::vector<Vec2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Vec2& q : p) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), q) <= 0) hull.pop_back();
      hull.push_back(q);
    }
    if (!hull.empty()) hull.pop_back();  // the last point starts the other chain
    std::reverse(p.begin(), p.end());
  }
  return hull;
}

double tapeGirth(std::vector<Vec2> points) {
  const std::vector<Vec2> hull = convexHull(std::move(points));
  double length = 0;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Vec2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
    length += std::hypot(b.x - a.x, b.y - a.y);
  }
  return length;
}

}  // namespace gambeson
