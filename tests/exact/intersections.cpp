#include "exact/intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>
#include <CGAL/intersections.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>

#include "core/error.hpp"

namespace gambeson::exact {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;
using Triangle = Kernel::Triangle_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, int>;

class Mesh {
 public:
  Mesh(std::span<const Vec3> x, std::span<const std::array<int, 3>> triangles) : triangles_(triangles) {
    points_.reserve(x.size());
    for (const Vec3& p : x) points_.emplace_back(p.x, p.y, p.z);
    for (const auto& [a, b, c] : triangles) collapsed_.push_back(CGAL::collinear(points_[a], points_[b], points_[c]));
  }

  bool collapsed(int t) const { return collapsed_[t]; }

  Box box(int t) const {
    const auto& [a, b, c] = triangles_[t];
    return {points_[a].bbox() + points_[b].bbox() + points_[c].bbox(), t};
  }

  /// Common vertices of two triangles come first, in the same order, in the corners that are returned.
  int shared(std::array<int, 3>& s, std::array<int, 3>& t) const {
    int n = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = n; j < 3; ++j)
        if (s[i] == t[j]) {
          std::swap(s[i], s[n]);
          std::swap(t[j], t[n]);
          ++n;
          break;
        }
    return n;
  }

  /// The number of common vertices, or -1 where they do not intersect.
  int meet(int first, int second) const {
    std::array<int, 3> s = triangles_[first], t = triangles_[second];
    const int n = shared(s, t);
    const bool flat = collapsed_[first] || collapsed_[second];
    if (n > 0 && flat) return -1;
    return (n == 0 ? disjointMeet(first, second) : n == 1 ? atVertex(s, t) : n == 2 ? atEdge(s, t) : true) ? n : -1;
  }

 private:
  Triangle triangle(const std::array<int, 3>& t) const { return {points_[t[0]], points_[t[1]], points_[t[2]]}; }

  /// The two ends of a triangle whose corners lie on a line: the first and the last in lexicographic order.
  Segment segment(int t) const {
    std::array<Point, 3> p{points_[triangles_[t][0]], points_[triangles_[t][1]], points_[triangles_[t][2]]};
    std::sort(p.begin(), p.end());
    return {p[0], p[2]};
  }

  /// CGAL asks for segments with two ends.
  static bool meets(const Segment& s, const Segment& t) {
    if (s.is_degenerate()) return t.is_degenerate() ? s.source() == t.source() : t.has_on(s.source());
    return t.is_degenerate() ? s.has_on(t.source()) : CGAL::do_intersect(s, t);
  }
  static bool meets(const Segment& s, const Triangle& t) {
    return s.is_degenerate() ? t.has_on(s.source()) : CGAL::do_intersect(s, t);
  }

  bool disjointMeet(int s, int t) const {
    if (collapsed_[s] && collapsed_[t]) return meets(segment(s), segment(t));
    if (collapsed_[s]) return meets(segment(s), triangle(triangles_[t]));
    if (collapsed_[t]) return meets(segment(t), triangle(triangles_[s]));
    return CGAL::do_intersect(triangle(triangles_[s]), triangle(triangles_[t]));
  }

  bool atVertex(const std::array<int, 3>& s, const std::array<int, 3>& t) const {
    return CGAL::do_intersect(Segment(points_[s[1]], points_[s[2]]), triangle(t)) ||
           CGAL::do_intersect(Segment(points_[t[1]], points_[t[2]]), triangle(s));
  }

  bool atEdge(const std::array<int, 3>& s, const std::array<int, 3>& t) const {
    const Point &a = points_[s[0]], &b = points_[s[1]], &c = points_[s[2]], &d = points_[t[2]];
    return CGAL::coplanar(a, b, c, d) && CGAL::coplanar_orientation(a, b, c, d) == CGAL::POSITIVE;
  }

  std::span<const std::array<int, 3>> triangles_;
  std::vector<Point> points_;
  std::vector<char> collapsed_;
};

}  // namespace

Intersections intersections(std::span<const Vec3> x, std::span<const std::array<int, 3>> triangles,
                            std::span<const char> obstacle) {
  assert(obstacle.empty() || obstacle.size() == x.size());
  for (const Vec3& p : x)
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) throw RunError("a position is not finite");
  const Mesh mesh(x, triangles);
  Intersections out;
  std::vector<Box> cloth, bodies;
  for (int t = 0; t < static_cast<int>(triangles.size()); ++t) {
    (!obstacle.empty() && obstacle[triangles[t][0]] ? bodies : cloth).push_back(mesh.box(t));
    if (mesh.collapsed(t)) out.collapsed.push_back(t);
  }
  const auto test = [&](const Box& p, const Box& q) {
    const int a = std::min(p.info(), q.info()), b = std::max(p.info(), q.info());
    const int shared = mesh.meet(a, b);
    if (shared >= 0) out.pairs.push_back({a, b, shared});
  };
  CGAL::box_intersection_d(cloth.begin(), cloth.end(), bodies.begin(), bodies.end(), test);
  CGAL::box_self_intersection_d(cloth.begin(), cloth.end(), test);
  std::sort(out.pairs.begin(), out.pairs.end(), [](const IntersectingPair& p, const IntersectingPair& q) {
    return std::tie(p.a, p.b) < std::tie(q.a, q.b);
  });
  return out;
}

}  // namespace gambeson::exact
