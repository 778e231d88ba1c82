#include "core/contact/contour_point.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson {
namespace {

struct Interval {
  double lo = 0, hi = 1;
};

/// The part of p + t (q - p), 0 <= t <= 1, over a triangle that lies in the same plane, seen along the normal n.
Interval overlapInPlane(const std::array<Vec3, 3>& corner, const Vec3& n, const Vec3& p, const Vec3& q) {
  Interval part;
  for (int k = 0; k < 3; ++k) {
    const Vec3& a = corner[k];
    const Vec3 inward = cross(n, corner[(k + 1) % 3] - a);
    const double at_p = dot(inward, p - a), at_q = dot(inward, q - a);
    if (at_p < 0 && at_q >= 0) part.lo = std::max(part.lo, at_p / (at_p - at_q));
    if (at_p >= 0 && at_q < 0) part.hi = std::min(part.hi, at_p / (at_p - at_q));
  }
  return part;
}

}  // namespace

ContourPoint crossingPoint(const ContactMesh& mesh, std::span<const Vec3> x, int edge, int triangle) {
  ContourPoint point;
  point.edge = edge;
  point.triangle = triangle;
  const Vec3 &p = x[mesh.edges[edge][0]], &q = x[mesh.edges[edge][1]];
  std::array<Vec3, 3> corner;
  for (int k = 0; k < 3; ++k) corner[k] = x[mesh.triangles[triangle][k]];
  const Vec3 n = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double at_p = dot(n, p - corner[0]), at_q = dot(n, q - corner[0]);
  double t;
  if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) {
    t = at_p / (at_p - at_q);
  } else if ((at_p == 0) != (at_q == 0)) {
    t = at_p == 0 ? 0 : 1;
  } else {  // in the plane, or too near to it to tell
    const Interval part = overlapInPlane(corner, n, p, q);
    t = std::clamp(0.5 * (part.lo + part.hi), 0.0, 1.0);
  }
  point.edge_weight = {1 - t, t};
  point.x = (1 - t) * p + t * q;
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 opposite = cross(corner[(k + 2) % 3] - corner[(k + 1) % 3], point.x - corner[(k + 1) % 3]);
    sum += point.triangle_weight[k] = std::max(0.0, dot(n, opposite));
  }
  for (auto& w : point.triangle_weight) w = sum > 0 ? w / sum : 1.0 / 3;  // a triangle without area: its centre
  return point;
}

}  // namespace gambeson
