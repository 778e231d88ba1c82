#include "human/skin/mesh.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/math/parallel.hpp"
#include "human/skin/remesh.hpp"

namespace gambeson {
namespace {

/// Kuhn's six tetrahedra of a cube: corners by bits x, y, z; each runs from 000 to 111 along one order of the axes.
constexpr int kTets[6][4] = {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}};

struct Grid {
  Vec3 origin;
  double h;
  int nx, ny, nz;
  int node(int i, int j, int k) const { return (k * ny + j) * nx + i; }
  Vec3 at(int node) const {
    const int i = node % nx, j = node / nx % ny, k = node / (nx * ny);
    return {origin.x + h * i, origin.y + h * j, origin.z + h * k};
  }
};

/// The surface in y >= 0, with its border on y = 0 exactly.
TriangleMesh marchHalf(const ImplicitSurface& s, double h) {
  const double margin = 2 * h;
  Grid g{{s.low.x - margin, 0, s.low.z - margin}, h, 0, 0, 0};
  g.nx = static_cast<int>(std::ceil((s.high.x + margin - g.origin.x) / h)) + 1;
  g.ny = static_cast<int>(std::ceil((s.high.y + margin) / h)) + 1;
  g.nz = static_cast<int>(std::ceil((s.high.z + margin - g.origin.z) / h)) + 1;
  const int n = g.nx * g.ny * g.nz;
  std::vector<double> f(n);
  forAll(Each::much, n, [&](int i) { f[i] = s.value(g.at(i)); });

  TriangleMesh m;
  std::vector<int> point(static_cast<std::size_t>(n) * 8, -1);  // by lower node and direction bits of the grid's edge
  const int step[3] = {1, g.nx, g.nx * g.ny};
  const auto offset = [&](int bits) {
    return (bits & 1 ? step[0] : 0) + (bits & 2 ? step[1] : 0) + (bits & 4 ? step[2] : 0);
  };
  const auto cut = [&](int node, int c, int d) {
    if (c > d) std::swap(c, d);  // along Kuhn's orders a later corner has more bits
    const int p = node + offset(c), q = node + offset(d);
    int& v = point[static_cast<std::size_t>(p) * 8 + (d & ~c)];
    if (v < 0) {
      v = static_cast<int>(m.vertices.size());
      // Away from the nodes: the points are moved onto the surface later, here they should make no sliver.
      const double u = std::clamp(f[p] / (f[p] - f[q]), 0.15, 0.85);
      m.vertices.push_back((1 - u) * g.at(p) + u * g.at(q));
    }
    return v;
  };
  const auto triangle = [&](int a, int b, int c, const Vec3& outward) {
    const Vec3 &x = m.vertices[a], normal = cross(m.vertices[b] - x, m.vertices[c] - x);
    if (dot(normal, outward) > 0)
      m.triangles.push_back({a, b, c});
    else
      m.triangles.push_back({a, c, b});
  };
  for (int k = 0; k + 1 < g.nz; ++k)
    for (int j = 0; j + 1 < g.ny; ++j)
      for (int i = 0; i + 1 < g.nx; ++i) {
        const int node = g.node(i, j, k);
        int inside = 0;
        for (int c = 0; c < 8; ++c) inside += f[node + offset(c)] < 0;
        if (inside == 0 || inside == 8) continue;
        for (const auto& tet : kTets) {
          int in[4], out[4], ni = 0, no = 0;
          Vec3 outward;
          for (const int c : tet) {
            const bool negative = f[node + offset(c)] < 0;
            (negative ? in[ni++] : out[no++]) = c;
          }
          if (ni == 0 || no == 0) continue;
          for (int a = 0; a < no; ++a) outward += g.at(node + offset(out[a])) / no;
          for (int a = 0; a < ni; ++a) outward -= g.at(node + offset(in[a])) / ni;
          if (ni == 1)
            triangle(cut(node, in[0], out[0]), cut(node, in[0], out[1]), cut(node, in[0], out[2]), outward);
          else if (no == 1)
            triangle(cut(node, in[0], out[0]), cut(node, in[1], out[0]), cut(node, in[2], out[0]), outward);
          else {
            const int a = cut(node, in[0], out[0]), b = cut(node, in[0], out[1]), c = cut(node, in[1], out[1]),
                      d = cut(node, in[1], out[0]);
            triangle(a, b, c, outward);
            triangle(a, c, d, outward);
          }
        }
      }
  return m;
}

TriangleMesh mirrored(const TriangleMesh& half) {
  TriangleMesh m = half;
  std::vector<int> twin(half.vertices.size());
  for (std::size_t v = 0; v < half.vertices.size(); ++v) {
    const Vec3& x = half.vertices[v];
    twin[v] = static_cast<int>(x.y == 0 ? v : m.vertices.size());
    if (x.y != 0) m.vertices.push_back({x.x, -x.y, x.z});
  }
  for (const auto& t : half.triangles) m.triangles.push_back({twin[t[0]], twin[t[2]], twin[t[1]]});
  return m;
}

}  // namespace

TriangleMesh meshOf(const ImplicitSurface& surface, double cell_m) {
  assert(cell_m > 0);
  return mirrored(remeshHalf(marchHalf(surface, cell_m), surface));
}

}  // namespace gambeson
