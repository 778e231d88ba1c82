#include "cases/structure/self_crossings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gambeson {
namespace {

struct Mesh {
  std::vector<Vec3> points;
  std::vector<std::array<int, 3>> triangles;
};

/// A grid of n x n squares over [0, 1]^2 placed by f.
template <class F>
void addGrid(Mesh& m, int n, F f) {
  const int first = static_cast<int>(m.points.size()), row = n + 1;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) m.points.push_back(f(i / double(n), j / double(n)));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int k = first + i + row * j;
      m.triangles.push_back({k, k + 1, k + row + 1});
      m.triangles.push_back({k, k + row + 1, k + row});
    }
}

long crossings(const Mesh& m) { return selfCrossings(m.points, m.triangles); }

/// Two triangles whose planes are square to each other, one slid along: they cross, touch in a point, and part.
TEST(SelfCrossings, TwoTriangles) {
  const auto slid = [](double x) {
    Mesh m;
    m.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {x + 0.2, 0.2, -1}, {x + 0.2, 0.2, 1}, {x + 2, 0.3, 0}};
    m.triangles = {{0, 1, 2}, {3, 4, 5}};
    return crossings(m);
  };
  EXPECT_EQ(slid(0), 1);
  EXPECT_EQ(slid(0.59), 1);
  EXPECT_EQ(slid(0.61), 0);
}

/// Neighbours share vertices, across a seam by place only: a flat sheet, a closed tube and a sharp fold have none.
TEST(SelfCrossings, NeighboursDoNotCount) {
  Mesh flat, tube, fold;
  addGrid(flat, 8, [](double u, double v) { return Vec3{u, v, 0}; });
  addGrid(tube, 16, [](double u, double v) { return Vec3{std::cos(2 * M_PI * u), std::sin(2 * M_PI * u), v}; });
  addGrid(fold, 8, [](double u, double v) { return Vec3{std::abs(u - 0.5), v, u < 0.5 ? 0 : 0.01 * (u - 0.5)}; });
  EXPECT_EQ(crossings(flat), 0);
  EXPECT_EQ(crossings(tube), 0);
  EXPECT_EQ(crossings(fold), 0);
}

/// A loop that passes through itself along a line of 8 squares: two sheets at right angles cross in pairs of triangles
/// whose number is known: along the line each of n squares of one meets those of the other in the same strip.
TEST(SelfCrossings, TwoSheets) {
  for (const int n : {3, 7}) {
    Mesh m;
    addGrid(m, n, [](double u, double v) { return Vec3{u, v, 0}; });
    // Off the grid lines of the first, so that strips overlap in pairs: 0.5 lies inside a square for odd n.
    addGrid(m, n, [](double u, double v) { return Vec3{0.503, v + 1e-3, u - 0.501}; });
    const long once = crossings(m);
    EXPECT_GE(once, 3 * n - 2);
    EXPECT_LE(once, 8 * n);
    Mesh apart = m;
    for (std::size_t k = apart.points.size() / 2; k < apart.points.size(); ++k) apart.points[k].z += 0.6;
    EXPECT_EQ(crossings(apart), 0);
  }
}

}  // namespace
}  // namespace gambeson
