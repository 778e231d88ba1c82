#include "cases/structure/self_crossings.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace gambeson {
namespace {

using Corners = std::array<Vec3, 3>;

/// Six times the volume of a tetrahedron, with its sign.
double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return dot(b - a, cross(c - a, d - a)); }

/// The edge pq passes through the inside of t: its ends lie on both sides, and pq turns alike about all three edges.
bool pierces(const Vec3& p, const Vec3& q, const Corners& t) {
  if (!(volume(p, t[0], t[1], t[2]) * volume(q, t[0], t[1], t[2]) < 0)) return false;
  const double a = volume(p, q, t[0], t[1]), b = volume(p, q, t[1], t[2]), c = volume(p, q, t[2], t[0]);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

bool cross(const Corners& a, const Corners& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (pierces(a[k], a[(k + 1) % 3], b) || pierces(b[k], b[(k + 1) % 3], a)) return true;
  return false;
}

struct Boxed {
  Corners corners;
  Vec3 low, high;
};

}  // namespace

long selfCrossings(std::span<const Vec3> points, std::span<const std::array<int, 3>> triangles) {
  std::vector<Boxed> boxed;
  double size = 0;
  for (const std::array<int, 3>& t : triangles) {
    Boxed b;
    for (std::size_t k = 0; k < 3; ++k) b.corners[k] = points[static_cast<std::size_t>(t[k])];
    b.low = b.high = b.corners[0];
    for (const Vec3& x : b.corners)
      for (int d = 0; d < 3; ++d) {
        b.low[d] = std::min(b.low[d], x[d]);
        b.high[d] = std::max(b.high[d], x[d]);
      }
    size = std::max(size, norm(b.high - b.low));
    boxed.push_back(b);
  }
  // Sweep along x: only boxes that overlap there meet.
  std::sort(boxed.begin(), boxed.end(), [](const Boxed& a, const Boxed& b) { return a.low.x < b.low.x; });
  const double same2 = 1e-18 * size * size;
  const auto neighbours = [&](const Corners& a, const Corners& b) {
    for (const Vec3& x : a)
      for (const Vec3& y : b)
        if (norm2(x - y) <= same2) return true;
    return false;
  };
  long count = 0;
  for (std::size_t i = 0; i < boxed.size(); ++i)
    for (std::size_t j = i + 1; j < boxed.size() && boxed[j].low.x <= boxed[i].high.x; ++j) {
      const Boxed &a = boxed[i], &b = boxed[j];
      if (a.low.y > b.high.y || b.low.y > a.high.y || a.low.z > b.high.z || b.low.z > a.high.z) continue;
      if (!neighbours(a.corners, b.corners) && cross(a.corners, b.corners)) ++count;
    }
  return count;
}

}  // namespace gambeson
