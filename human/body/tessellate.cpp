#include "human/body/tessellate.hpp"

#include <cmath>
#include <numbers>

namespace gambeson {

TriangleMesh boxMesh(const Vec3& size) {
  TriangleMesh m;
  for (int i = 0; i < 8; ++i)
    m.vertices.push_back(0.5 * Vec3{i & 1 ? size.x : -size.x, i & 2 ? size.y : -size.y, i & 4 ? size.z : -size.z});
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& q : quads) {
    m.triangles.push_back({q[0], q[1], q[2]});
    m.triangles.push_back({q[0], q[2], q[3]});
  }
  return m;
}

TriangleMesh cylinderMesh(double radius, double length) {
  constexpr int n = 48;
  TriangleMesh m;
  m.vertices = {{0, 0, -length / 2}, {0, 0, length / 2}};
  for (int i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * i / n, x = radius * std::cos(a), y = radius * std::sin(a);
    m.vertices.push_back({x, y, -length / 2});
    m.vertices.push_back({x, y, length / 2});
  }
  for (int i = 0; i < n; ++i) {
    const int a = 2 + 2 * i, b = 2 + 2 * ((i + 1) % n);
    m.triangles.push_back({0, b, a});
    m.triangles.push_back({1, a + 1, b + 1});
    m.triangles.push_back({a, b, b + 1});
    m.triangles.push_back({a, b + 1, a + 1});
  }
  return m;
}

}  // namespace gambeson
