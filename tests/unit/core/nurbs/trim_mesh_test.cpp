/// Triangles and samples of trimmed patches: the outline is the loop, nothing overlaps, areas are consistent.

#include "core/nurbs/trim_mesh.hpp"
#include "core/cloth/draft/areas.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/cloth/patches/surface.hpp"
#include "core/error.hpp"
#include "unit/core/nurbs/trim_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

std::vector<double> lines(int n) {
  std::vector<double> out;
  for (int k = 0; k <= n; ++k) out.push_back(static_cast<double>(k) / n);
  return out;
}

struct MeshFacts {
  double area = 0, smallest_angle = 10;
  int edges_of_more_than_two = 0;
  std::vector<std::array<Vec2, 2>> outline;  ///< edges of one triangle
};

MeshFacts facts(const TrimMesh& m) {
  MeshFacts f;
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : m.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec2 a = m.uv[t[k]], b = m.uv[t[(k + 1) % 3]], c = m.uv[t[(k + 2) % 3]];
      const double turn = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
      f.area += turn / 6;
      EXPECT_GT(turn, 0);
      f.smallest_angle = std::min(f.smallest_angle,
                                  std::atan2(turn, (b.x - a.x) * (c.x - a.x) + (b.y - a.y) * (c.y - a.y)) * 180 / kPi);
      ++edges[std::minmax(t[k], t[(k + 1) % 3])];
    }
  for (const auto& [e, count] : edges) {
    f.edges_of_more_than_two += count > 2;
    if (count == 1) f.outline.push_back({m.uv[e.first], m.uv[e.second]});
  }
  return f;
}

TEST(TrimMesh, OutlineIsTheLoop) {
  // Circles shifted through a cell. A chord spans a cell's diagonal and, where edges shrank, 0.3 h at each end: at most
  // 2.02 h. On a circle of radius R it leaves a segment of area chord^3 / (12 R), sagitta chord^2 / (8 R).
  const NurbsPatch patch = unitPatch(2, 8);
  const int n = 16;
  const double h = 1.0 / n, R = 0.31;
  double smallest_angle = 90, worst_area = 0;
  for (int k = 0; k < 40; ++k)
    for (bool hole : {true, false}) {
      const Vec2 c{0.47 + k * h / 40, 0.53 + 0.37 * k * h / 40};
      const TrimMesh m = trimMesh(patch, {{{circle(c, R, R, hole)}}}, lines(n), lines(n));
      const MeshFacts f = facts(m);
      EXPECT_EQ(f.edges_of_more_than_two, 0);
      for (const auto& edge : f.outline) {
        const bool border = (edge[0].x == edge[1].x && (edge[0].x == 0 || edge[0].x == 1)) ||
                            (edge[0].y == edge[1].y && (edge[0].y == 0 || edge[0].y == 1));
        if (border) continue;
        for (Vec2 p : edge) EXPECT_NEAR(std::hypot(p.x - c.x, p.y - c.y), R, 1e-12);
        const Vec2 mid{0.5 * (edge[0].x + edge[1].x), 0.5 * (edge[0].y + edge[1].y)};
        EXPECT_LT(R - std::hypot(mid.x - c.x, mid.y - c.y), std::pow(2.02 * h, 2) / (8 * R));
      }
      smallest_angle = std::min(smallest_angle, f.smallest_angle);
      worst_area = std::max(worst_area, std::abs(f.area - (hole ? 1 - kPi * R * R : kPi * R * R)));
    }
  EXPECT_GT(smallest_angle, 3);  // degrees; measured 4.4 over 200 shifts
  EXPECT_LT(worst_area, 2 * kPi * R * std::pow(2.02 * h, 2) / (12 * R));
}

TEST(TrimMesh, PolygonsAreCoveredExactly) {
  const NurbsPatch patch = unitPatch(2, 8);
  const std::vector<std::vector<Vec2>> shapes = {{{0.5, 0.2}, {0.8, 0.5}, {0.5, 0.8}, {0.2, 0.5}},
                                                 {{0.1, 0.1}, {0.9, 0.12}, {0.9, 0.13}, {0.1, 0.11}},  // thin strip
                                                 {{0, 0}, {0.53, 0}, {0.53, 1}, {0, 1}},
                                                 {{0.51, 0.51}, {0.54, 0.515}, {0.53, 0.54}},  // within one cell
                                                 {{0.1, 0.1}, {0.3, 0.15}, {0.35, 0.4}, {0.2, 0.25}}};
  for (const auto& shape : shapes) {
    double area = 0;
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const Vec2 a = shape[k], b = shape[(k + 1) % shape.size()];
      area += 0.5 * (a.x * b.y - b.x * a.y);
    }
    const auto kept = facts(trimMesh(patch, {{polygon(shape)}}, lines(16), lines(16)));
    const auto left =
        facts(trimMesh(patch, {{polygon(std::vector<Vec2>(shape.rbegin(), shape.rend()))}}, lines(16), lines(16)));
    EXPECT_NEAR(kept.area, area, 1e-12);
    EXPECT_NEAR(left.area, 1 - area, 1e-12);
    EXPECT_EQ(kept.edges_of_more_than_two + left.edges_of_more_than_two, 0);
  }
  // Several holes in one cell, one touching its grid lines, and a circle through grid points, tangent to grid lines.
  const Trim small{{{circle({0.47, 0.53}, 0.01, 0.01, true)},
                    {circle({0.48, 0.555}, 0.005, 0.005, true)},
                    {circle({0.7, 0.7 + 0.0125 - 0.0025}, 0.0125 - 0.0025 + 0.0025, 0.01, true)},
                    {circle({0.25, 0.25}, 0.125, 0.125, true)}}};
  const auto f = facts(trimMesh(patch, small, lines(16), lines(16)));
  EXPECT_EQ(f.edges_of_more_than_two, 0);
  EXPECT_NEAR(f.area, keptArea(patch, {small.loops, 8}), 0.004);
  EXPECT_GT(f.smallest_angle, 2);
}

Garment trimmedGarment(NurbsPatch patch, std::vector<TrimLoop> loops) {
  Garment g = garmentOf({std::move(patch)}, {}, plainFabric());
  g.trims = {{std::move(loops)}};
  return g;
}

Eigen::MatrixXd dense(const SparseRows& rows) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(rows.rows(), rows.column_count);
  for (int r = 0; r < rows.rows(); ++r)
    for (int k = rows.offsets[r]; k < rows.offsets[r + 1]; ++k) m(r, rows.columns[k]) += rows.values[k];
  return m;
}

TEST(TrimSurface, RowsRankAndPositiveConsistentAreas) {
  for (int p : {2, 3})
    for (int shape = 0; shape < 4; ++shape) {
      const Vec2 c{0.48, 0.54};
      const double r = 0.31;
      const std::vector<Vec2> diamond{{c.x - r, c.y}, {c.x, c.y - r}, {c.x + r, c.y}, {c.x, c.y + r}};
      const TrimLoop loop = shape == 0   ? TrimLoop{circle(c, r, r, true)}
                            : shape == 1 ? TrimLoop{circle(c, r, r, false)}
                            : shape == 2 ? TrimLoop(polygon(diamond))
                                         : TrimLoop{circle(c, 0.04, 0.04, true)};
      const Garment g = trimmedGarment(unitPatch(p, 6), {loop});
      const FreeMap map = buildFreeMap(g);
      const Surface s = buildSurface(g, map, 2);
      const Eigen::MatrixXd W = dense(s.W), WT = dense(s.WT);
      EXPECT_LT((WT.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-11);
      EXPECT_EQ(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(WT).rank(), WT.cols());
      const Eigen::Map<const Eigen::VectorXd> a(s.area_m2.data(), s.size());
      EXPECT_GT(a.minCoeff(), 0);
      std::vector<double> A(map.home.size());
      map.Tt.multiply<double>(controlAreas(g), A);
      const Eigen::Map<const Eigen::VectorXd> expected(A.data(), static_cast<long>(A.size()));
      EXPECT_LT((WT.transpose() * a - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.maxCoeff());
      // Every sample is kept, in use, and where the grid says.
      std::vector<int> uses(s.size(), 0);
      for (const auto& t : s.triangles)
        for (int i : t) ++uses[i];
      EXPECT_GT(*std::min_element(uses.begin(), uses.end()), 0);
      for (const Vec2& uv : s.parameters) EXPECT_TRUE(isKept(g.patches[0], g.trims[0], uv));
      const auto [nu, nv] = s.patch_grid_size[0];
      int left = 0;
      for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i)
          if (const int at = s.patch_grid[0][i + nu * j]; at >= 0) {
            ++left;
            EXPECT_DOUBLE_EQ(s.parameters[at].x, i / 12.0);
            EXPECT_DOUBLE_EQ(s.parameters[at].y, j / 12.0);
          }
      EXPECT_LT(left, nu * nv);
    }
}

TEST(TrimSurface, EdgesAndSeams) {
  // A notch in the free side of a joined patch: its edge keeps what the notch leaves, and the corners of the notch.
  Garment g = fourPatches(2, 2, false, SeamKind::G1, 0, plainFabric());
  g.trims.resize(4);
  const NurbsPatch& p = g.patches[0];
  const double u0 = p.u.front(), v0 = p.v.front(), dv = p.v.back() - v0, du = p.u.back() - u0;
  g.trims[0].loops = {
      polygon(std::vector<Vec2>{{u0, v0 + 0.2 * dv}, {u0, v0 + 0.45 * dv}, {u0 + 0.2 * du, v0 + 0.3 * dv}})};
  const FreeMap map = buildFreeMap(g);
  const Surface s = buildSurface(g, map, 3);
  std::vector<int> edge = edgeSamples(s, {0, Side::u0, false});
  bool low = false, high = false;
  for (int i : edge) {
    ASSERT_GE(i, 0);
    const double v = (s.parameters[i].y - v0) / dv;
    EXPECT_TRUE(v <= 0.2 + 1e-9 || v >= 0.45 - 1e-9) << v;
    low = low || std::abs(v - 0.2) < 1e-9, high = high || std::abs(v - 0.45) < 1e-9;
  }
  EXPECT_TRUE(low && high);
  std::vector<int> back = edgeSamples(s, {0, Side::u0, true});
  std::reverse(back.begin(), back.end());
  EXPECT_EQ(edge, back);
  for (const Seam& seam : g.seams) EXPECT_EQ(edgeSamples(s, seam.a), edgeSamples(s, seam.b));
}

TEST(TrimSurface, MirroredHolesGiveMirroredAreas) {
  const TrimLoop hole{circle({0.43, 0.56}, 0.2, 0.27, true)};
  const Garment a = trimmedGarment(unitPatch(2, 7), {hole}), b = trimmedGarment(unitPatch(2, 7), {mirroredU(hole)});
  const Surface sa = buildSurface(a, buildFreeMap(a), 2), sb = buildSurface(b, buildFreeMap(b), 2);
  ASSERT_EQ(sa.size(), sb.size());
  for (int i = 0; i < sa.size(); ++i) {
    double nearest = 1;
    for (int j = 0; j < sb.size(); ++j)
      nearest = std::min(
          nearest, std::hypot(sa.parameters[i].x + sb.parameters[j].x - 1, sa.parameters[i].y - sb.parameters[j].y));
    EXPECT_LT(nearest, 1e-12);
  }
}

}  // namespace
}  // namespace gambeson
