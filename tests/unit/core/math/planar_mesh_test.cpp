#include "core/math/planar_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

using Loop = std::vector<Vec2>;

/// A closed polygon with its edges divided.
Loop divided(const Loop& corners, double spacing) {
  Loop out;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec2 a = corners[k], b = corners[(k + 1) % corners.size()];
    const int n = std::max(1, static_cast<int>(std::lround(std::hypot(b.x - a.x, b.y - a.y) / spacing)));
    for (int i = 0; i < n; ++i) out.push_back({a.x + (b.x - a.x) * i / n, a.y + (b.y - a.y) * i / n});
  }
  return out;
}

double areaOf(const Loop& loop) {
  double sum = 0;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Vec2 a = loop[k], b = loop[(k + 1) % loop.size()];
    sum += 0.5 * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

/// It covers the loops once, has every edge of them and no other border; returns the flattest triangle.
double checkCovers(const std::vector<Loop>& loops, double spacing) {
  const PlanarMesh mesh = planarMesh(loops, spacing);
  double area = 0, wanted = 0, flattest = 1;
  std::map<std::pair<int, int>, int> edges;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    Loop corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners.push_back(mesh.points[static_cast<std::size_t>(v[k])]);
      const int count = ++edges[{v[k], v[(k + 1) % 3]}];
      EXPECT_EQ(count, 1) << "an edge runs twice in one sense";
    }
    EXPECT_GT(areaOf(corners), 0);
    area += areaOf(corners);
    flattest = std::min(flattest, flatness(mesh, t));
  }
  int first = 0;
  std::size_t border = 0;
  for (const Loop& loop : loops) {
    wanted += areaOf(loop);
    const int n = static_cast<int>(loop.size());
    for (int k = 0; k < n; ++k) {
      const std::size_t at = static_cast<std::size_t>(first + k);
      EXPECT_EQ(mesh.points[at].x, loop[static_cast<std::size_t>(k)].x);
      EXPECT_TRUE(edges.contains({first + k, first + (k + 1) % n}));
    }
    first += n, border += loop.size();
  }
  std::size_t alone = 0;
  for (const auto& [edge, count] : edges) alone += !edges.contains({edge.second, edge.first});
  EXPECT_EQ(alone, border);
  EXPECT_NEAR(area, wanted, 1e-12 * wanted);
  return flattest;
}

TEST(PlanarMesh, ASquareIsCoveredByGoodTriangles) {
  const double h = 0.05;
  EXPECT_GT(checkCovers({divided({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, h)}, h), 0.4);
  const PlanarMesh mesh = planarMesh(std::vector<Loop>{divided({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, h)}, h);
  // As many as equilateral triangles of this side, within a row at the border.
  EXPECT_NEAR(static_cast<double>(mesh.triangles.size()), 4 / (std::sqrt(3.0) * h * h), 80);
}

TEST(PlanarMesh, NotchesSlitsAndHoles) {
  const double h = 0.05;
  // A dart: the tip is one point, its legs run close to each other.
  EXPECT_GT(checkCovers({divided({{0, 0}, {0.48, 0}, {0.5, 0.5}, {0.52, 0}, {1, 0}, {1, 1}, {0, 1}}, h)}, h), 0.2);
  Loop hole;
  for (int k = 0; k < 20; ++k)
    hole.push_back(
        {0.5 + 0.2 * std::cos(-2 * std::numbers::pi * k / 20), 0.5 + 0.2 * std::sin(-2 * std::numbers::pi * k / 20)});
  Loop other = divided({{0.1, 0.1}, {0.1, 0.2}, {0.2, 0.2}, {0.2, 0.1}}, h);
  EXPECT_GT(checkCovers({divided({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, h), hole, other}, h), 0.25);
  // Narrower than a side, and coarser than the whole.
  EXPECT_GT(checkCovers({divided({{0, 0}, {1, 0}, {1, 0.02}, {0, 0.02}}, h)}, h), 0.25);
  checkCovers({{{0, 0}, {1, 0}, {0.2, 0.7}}}, 3);
}

TEST(PlanarMesh, RefusesWhatIsNoRegion) {
  EXPECT_THROW(planarMesh(std::vector<Loop>{{{0, 0}, {1, 1}, {1, 0}, {0, 1}}}, 0.1), InputError);
  EXPECT_THROW(planarMesh(std::vector<Loop>{{{0, 0}, {0, 1}, {1, 0}}}, 0.1), InputError);  // clockwise
  EXPECT_THROW(planarMesh(std::vector<Loop>{{{0, 0}, {1, 0}}}, 0.1), InputError);
  EXPECT_THROW(planarMesh(std::vector<Loop>{{{0, 0}, {1, 0}, {0, 1}}}, 0), InputError);
}

}  // namespace
}  // namespace gambeson
