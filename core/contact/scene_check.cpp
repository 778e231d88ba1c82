#include "core/contact/scene_check.hpp"

#include <cassert>
#include <cmath>
#include <map>
#include <tuple>

#include "core/contact/bounding_tree.hpp"
#include "core/contact/triangle.hpp"

namespace gambeson {

std::optional<Penetration> deepestPenetration(const ProximityQuery& query, std::span<const Placement> placement,
                                              std::span<const Vec3> points, const DeformedSurfaces* deformed) {
  std::vector<Contact> inside;
  const std::vector<double> reach(points.size(), 0.0);
  query.near(placement, placement, points, reach, inside, nullptr, deformed);
  std::optional<Penetration> deepest;
  for (const Contact& c : inside)
    if (-c.gap_m > (deepest ? deepest->depth_m : 0)) deepest = Penetration{-c.gap_m, c.sample, c.obstacle};
  return deepest;
}

TriangleMesh ellipsoidMesh(const Ellipsoid& shape, int levels) {
  const double t = 0.5 * (1 + std::sqrt(5.0));
  TriangleMesh m;
  // The icosahedron: corners of three golden rectangles.
  for (int axis = 0; axis < 3; ++axis)
    for (double s : {-1.0, 1.0})
      for (double u : {-t, t}) {
        Vec3 v;
        v[axis] = 0, v[(axis + 1) % 3] = s, v[(axis + 2) % 3] = u;
        m.vertices.push_back(normalized(v));
      }
  const int n = static_cast<int>(m.vertices.size());
  const double edge2 = 4 / (1 + t * t) * (1 + 1e-9);
  const auto joined = [&](int a, int b) { return norm2(m.vertices[a] - m.vertices[b]) < edge2; };
  for (int a = 0; a < n; ++a)
    for (int b = a + 1; b < n; ++b)
      for (int c = b + 1; c < n; ++c) {
        if (!joined(a, b) || !joined(b, c) || !joined(c, a)) continue;
        const Vec3 &A = m.vertices[a], &B = m.vertices[b], &C = m.vertices[c];
        if (dot(A, cross(B, C)) > 0)
          m.triangles.push_back({a, b, c});
        else
          m.triangles.push_back({a, c, b});
      }
  for (int l = 0; l < levels; ++l) {
    std::map<std::pair<int, int>, int> middle;
    const auto mid = [&](int a, int b) {
      const auto [it, added] =
          middle.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<int>(m.vertices.size()));
      if (added) m.vertices.push_back(normalized(m.vertices[a] + m.vertices[b]));
      return it->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : m.triangles) {
      const int ab = mid(a, b), bc = mid(b, c), ca = mid(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    m.triangles.swap(finer);
  }
  const Vec3& e = shape.semi_axes;
  for (Vec3& v : m.vertices) v = {v.x * e.x, v.y * e.y, v.z * e.z};
  return m;
}

std::vector<Piercing> piercings(std::span<const Obstacle> obstacles, std::span<const Placement> placement,
                                const TriangleMesh& cloth, int levels, const DeformedVertices& vertices) {
  assert(obstacles.size() == placement.size());
  std::vector<Box> boxes(cloth.triangles.size());
  for (std::size_t t = 0; t < boxes.size(); ++t)
    for (int i : cloth.triangles[t]) boxes[t].add(cloth.vertices[i]);
  const BoundingTree tree(boxes);
  std::vector<Piercing> out;
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    const auto* mesh = std::get_if<TriangleMesh>(&obstacles[o].shape);
    const TriangleMesh own = mesh ? TriangleMesh{} : ellipsoidMesh(std::get<Ellipsoid>(obstacles[o].shape), levels);
    const TriangleMesh& body = mesh ? *mesh : own;
    std::vector<Vec3> x;
    x.reserve(body.vertices.size());
    if (obstacles[o].deforms)
      x.assign(vertices[o].begin(), vertices[o].end());
    else
      for (const Vec3& p : body.vertices) x.push_back(placement[o] * p);
    std::vector<std::pair<int, int>> edges;
    for (const auto& t : body.triangles)
      for (int k = 0; k < 3; ++k) edges.emplace_back(std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3]));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    for (const auto& [v, w] : edges) {
      if (x[v] == x[w]) continue;
      Box box;
      box.add(x[v]), box.add(x[w]);
      const SegmentTest segment(x[v], x[w]);
      tree.overlapping(box, [&, v = v, w = w](int t) {
        const Vec3 &a = cloth.vertices[cloth.triangles[t][0]], &b = cloth.vertices[cloth.triangles[t][1]],
                   &c = cloth.vertices[cloth.triangles[t][2]];
        const Vec3 n = cross(b - a, c - a);
        const double g0 = dot(x[v] - a, n), g1 = dot(x[w] - a, n);
        if ((g0 > 0 && g1 > 0) || (g0 < 0 && g1 < 0) || !segment.lineMeets(a, b, c)) return;
        out.push_back({static_cast<int>(o), v, w, t});
      });
    }
  }
  std::sort(out.begin(), out.end(), [](const Piercing& a, const Piercing& b) {
    return std::tie(a.obstacle, a.v, a.w, a.triangle) < std::tie(b.obstacle, b.v, b.w, b.triangle);
  });
  return out;
}

}  // namespace gambeson
