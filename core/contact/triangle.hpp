#pragma once
/// One triangle: the closest point with the feature it lies on, and the crossing of a line segment.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/math/vec.hpp"

namespace gambeson {

/// Which part of a triangle abc: corner 0..2, edge 3 (ab), 4 (bc), 5 (ca), or the face.
enum TriangleFeature { kCorner0 = 0, kEdge0 = 3, kFace = 6 };

struct TrianglePoint {
  Vec3 position;
  double dist2_m2 = 0;
  int feature = kFace;
};

/// Closest point of a triangle to p. A triangle without area counts as its edges.
GAMBESON_HD inline TrianglePoint closestOnTriangle(const std::array<Vec3, 3>& corner, const Vec3& p) {
  const Vec3 n = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double n2 = norm2(n);
  TrianglePoint best;
  best.dist2_m2 = std::numeric_limits<double>::infinity();
  bool over_face = n2 > 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 &a = corner[k], &b = corner[(k + 1) % 3];
    const Vec3 e = b - a, r = p - a;
    if (dot(cross(n, e), r) > 0) continue;  // p lies on the face's side of this edge
    over_face = false;
    const double t = dot(r, e), length2 = norm2(e);
    TrianglePoint c;
    if (!(t > 0)) {
      c = {a, norm2(r), kCorner0 + k};
    } else if (!(t < length2)) {
      c = {b, norm2(p - b), kCorner0 + (k + 1) % 3};
    } else {
      c.position = a + (t / length2) * e;
      c.dist2_m2 = norm2(p - c.position);
      c.feature = kEdge0 + k;
    }
    if (c.dist2_m2 < best.dist2_m2) best = c;
  }
  if (over_face) {
    const double h = dot(p - corner[0], n) / n2;
    best = {p - h * n, h * h * n2, kFace};
  }
  return best;
}

/// A line segment p0 -> p1 against many triangles, watertight: a segment never slips between two triangles that share
/// an edge or a corner. Corners are projected one by one along the segment (sheared so that it is the third axis); the
/// edge functions of the projected corners are differences of two products, whose sign rounding cannot turn, and which
/// are exactly antisymmetric between neighbours. A zero counts as inside for both, so that a hit may be seen twice,
/// never missed. (After Woop, Benthin and Wald, 2013. Without contraction of multiply-add.)
class SegmentTest {
 public:
  SegmentTest(const Vec3& p0, const Vec3& p1) : p0_(p0), d_(p1 - p0) {
    const double ax = std::abs(d_.x), ay = std::abs(d_.y), az = std::abs(d_.z);
    kz_ = ax >= ay && ax >= az ? 0 : ay >= az ? 1 : 2;
    kx_ = (kz_ + 1) % 3, ky_ = (kz_ + 2) % 3;
    sx_ = d_[kx_] / d_[kz_], sy_ = d_[ky_] / d_[kz_];
  }

  /// Does the infinite line through p0 and p1 meet the triangle? Triangles seen edge-on do not count: their neighbours
  /// do.
  bool lineMeets(const Vec3& a, const Vec3& b, const Vec3& c) const {
    const Projected A = project(a), B = project(b), C = project(c);
    const double u = edge(B, C), v = edge(C, A), w = edge(A, B);
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return false;
    return u != 0 || v != 0 || w != 0;
  }

 private:
  struct Projected {
    double x, y;
  };
  Projected project(const Vec3& v) const {
    const Vec3 r = v - p0_;
    return {r[kx_] - sx_ * r[kz_], r[ky_] - sy_ * r[kz_]};
  }
  static double edge(const Projected& a, const Projected& b) { return a.x * b.y - a.y * b.x; }

  Vec3 p0_, d_;
  int kx_, ky_, kz_;
  double sx_, sy_;
};

}  // namespace gambeson
