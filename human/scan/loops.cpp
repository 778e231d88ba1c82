#include "human/scan/loops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "human/body/section.hpp"

namespace gambeson {
namespace {

using Edge = std::uint64_t;

Edge edgeOf(int a, int b) {
  return static_cast<Edge>(static_cast<std::uint32_t>(std::min(a, b))) << 32 |
         static_cast<std::uint32_t>(std::max(a, b));
}

void measure(CutLoop& loop) {
  double area = 0;
  Vec2 sum, mean;
  const std::size_t n = loop.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = loop.points[i], &b = loop.points[(i + 1) % n];
    const double w = a.x * b.y - a.y * b.x;
    area += 0.5 * w;
    sum.x += (a.x + b.x) * w / 6, sum.y += (a.y + b.y) * w / 6;
    mean.x += a.x / static_cast<double>(n), mean.y += a.y / static_cast<double>(n);
  }
  loop.area_m2 = std::abs(area);
  loop.centre = loop.area_m2 > 1e-9 ? Vec2{sum.x / area, sum.y / area} : mean;
}

}  // namespace

CutPlane CutPlane::across(const Vec3& origin, const Vec3& normal) {
  const Vec3 other = std::abs(normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 e1 = normalized(other - dot(other, normal) * normal);
  return {origin, e1, cross(normal, e1)};
}

double CutLoop::girth() const { return tapeGirth(points); }

double CutLoop::low(int axis) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2& p : points) least = std::min(least, axis == 0 ? p.x : p.y);
  return least;
}

double CutLoop::high(int axis) const {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec2& p : points) most = std::max(most, axis == 0 ? p.x : p.y);
  return most;
}

std::vector<CutLoop> cutLoops(const TriangleMesh& mesh, const CutPlane& plane) {
  const Vec3 n = plane.normal();
  std::vector<double> side(mesh.vertices.size());
  for (std::size_t v = 0; v < side.size(); ++v) side[v] = dot(n, mesh.vertices[v] - plane.origin);
  // Each crossed triangle joins two crossed edges.
  std::vector<std::array<Edge, 2>> joins;
  std::unordered_map<Edge, std::array<int, 2>> at;
  for (const auto& t : mesh.triangles) {
    std::array<Edge, 2> ends{};
    int found = 0;
    for (int k = 0; k < 3; ++k)
      if (const int a = t[k], b = t[(k + 1) % 3]; (side[a] < 0) != (side[b] < 0) && found < 2)
        ends[static_cast<std::size_t>(found++)] = edgeOf(a, b);
    if (found < 2) continue;
    for (const Edge e : ends) {
      auto& both = at.try_emplace(e, std::array{-1, -1}).first->second;
      (both[0] < 0 ? both[0] : both[1]) = static_cast<int>(joins.size());
    }
    joins.push_back(ends);
  }
  const auto pointOf = [&](Edge e) {
    const auto a = static_cast<std::size_t>(e >> 32), b = static_cast<std::size_t>(e & 0xffffffffu);
    const double s = side[a] / (side[a] - side[b]);
    const Vec3 x = mesh.vertices[a] + s * (mesh.vertices[b] - mesh.vertices[a]) - plane.origin;
    return Vec2{dot(x, plane.e1), dot(x, plane.e2)};
  };
  std::vector<char> used(joins.size(), 0);
  std::vector<CutLoop> loops;
  const auto follow = [&](std::size_t first, Edge from) {
    CutLoop loop;
    Edge e = from;
    for (int j = static_cast<int>(first); j >= 0 && !used[static_cast<std::size_t>(j)];) {
      used[static_cast<std::size_t>(j)] = 1;
      loop.points.push_back(pointOf(e));
      const auto& ends = joins[static_cast<std::size_t>(j)];
      e = ends[0] == e ? ends[1] : ends[0];
      const auto& both = at.at(e);
      j = both[0] == j ? both[1] : both[0];
      if (j < 0) loop.points.push_back(pointOf(e)), loop.closed = false;
    }
    measure(loop);
    loops.push_back(std::move(loop));
  };
  // Open curves first, from their ends, so that each is one.
  for (std::size_t j = 0; j < joins.size(); ++j)
    for (const Edge e : joins[j])
      if (!used[j] && at.at(e)[1] < 0) follow(j, e);
  for (std::size_t j = 0; j < joins.size(); ++j)
    if (!used[j]) follow(j, joins[j][0]);
  return loops;
}

const CutLoop* nearestLoop(const std::vector<CutLoop>& loops, const Vec2& to) {
  const CutLoop* best = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const CutLoop& l : loops)
    if (const double d = std::hypot(l.centre.x - to.x, l.centre.y - to.y); d < least) least = d, best = &l;
  return best;
}

}  // namespace gambeson
