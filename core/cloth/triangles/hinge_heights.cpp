#include "core/cloth/triangles/hinge_heights.hpp"

#include <algorithm>
#include <cmath>

namespace gambeson {
namespace {

TriangleHeight heightOver(const MembraneTriangle& t, int corner, int from) {
  // Corners flat in the basis of the threads: the inverse of g.
  const double det = t.g[0].x * t.g[1].y - t.g[0].y * t.g[1].x;
  const Vec2 at[3] = {{}, {t.g[1].y / det, -t.g[1].x / det}, {-t.g[0].y / det, t.g[0].x / det}};
  const auto find = [&](int c) { return std::find(t.corner.begin(), t.corner.end(), c) - t.corner.begin(); };
  const auto apex = find(corner), start = find(from), end = 3 - apex - start;
  const Vec2 e{at[end].x - at[start].x, at[end].y - at[start].y}, a{at[apex].x - at[start].x, at[apex].y - at[start].y};
  const double length = std::hypot(e.x, e.y);
  return {std::abs(e.x * a.y - e.y * a.x) / length, (e.x * a.x + e.y * a.y) / length, length};
}

/// The corner of the second triangle at which the edge starts: its own point there, which seams make another.
int startIn(const FoldHinge& h, const MembraneTriangle& second) {
  const auto apex = std::find(second.corner.begin(), second.corner.end(), h.corner[3]) - second.corner.begin();
  return second.corner[static_cast<std::size_t>((apex + 2) % 3)];  // it runs 1, 0, 3
}

}  // namespace

HingeHeights::HingeHeights(const FoldHinge& hinge, const MembraneTriangle& one, const MembraneTriangle& two)
    : first(heightOver(one, hinge.corner[2], hinge.corner[0])),
      second(heightOver(two, hinge.corner[3], startIn(hinge, two))) {}

double rigidityAcross(const FoldHinge& hinge, std::span<const double, 6> D) {
  const Vec3& d = hinge.d;
  return d.x * (D[0] * d.x + D[3] * d.y + D[4] * d.z) + d.y * (D[3] * d.x + D[1] * d.y + D[5] * d.z) +
         d.z * (D[4] * d.x + D[5] * d.y + D[2] * d.z);
}

}  // namespace gambeson
