/// How far cloth stands out between its samples, and that it stays out of bodies there.

#include "core/cloth/patches/bulge.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/motion/velocity_verlet.hpp"
#include "unit/core/contact/mesh_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// z = (a x^2 + b y^2)/2 + c x y over a rectangle with its middle at 0, exactly: control values of squares are products
/// of knots.
Garment sheetOver(double length, double width, int cells, double a, double b, double c, const Fabric& fabric) {
  NurbsPatch s{uniformKnots(2, cells), uniformKnots(2, 3), {}, {}};
  for (int j = 0; j < s.v.count(); ++j)
    for (int i = 0; i < s.u.count(); ++i) {
      const double x1 = length * (s.u.knots[i + 1] - 0.5), x2 = length * (s.u.knots[i + 2] - 0.5);
      const double y1 = width * (s.v.knots[j + 1] - 0.5), y2 = width * (s.v.knots[j + 2] - 0.5);
      const double x = 0.5 * (x1 + x2), y = 0.5 * (y1 + y2);
      s.points.push_back({x, y, 0.5 * (a * x1 * x2 + b * y1 * y2) + c * x * y});
      s.weights.push_back(1);
    }
  return garmentOf({s}, {}, fabric);
}

std::vector<Vec3> positions(const SparseRows& W, const Garment& g) {
  std::vector<Vec3> x(W.rows());
  W.multiply<Vec3>(g.patches[0].points, x);
  return x;
}

/// z = (a x^2 + b y^2)/2 + c x y is quadratic: every edge and diagonal of the grid of samples is told exactly, whatever
/// their number in a cell.
TEST(Bulge, OfQuadraticSurfacesIsExact) {
  const double a = 6, b = -4, c = 3;
  const Garment g = sheetOver(0.3, 0.2, 4, a, b, c, plainFabric());
  for (int per_cell : {2, 3}) {
    const Surface s = buildSurface(g, buildFreeMap(g), per_cell);
    const Bulges bulges = buildBulges(g, s, std::vector<int>{per_cell});
    const std::vector<Vec3> x = positions(s.W, g);
    const double hx = 0.3 / (4 * per_cell), hy = 0.2 / (3 * per_cell);
    double most = 0;
    for (int e = 0; e < bulges.middle.rows(); ++e) {
      Vec3 out{};
      for (int k = bulges.middle.offsets[e]; k < bulges.middle.offsets[e + 1]; ++k)
        out += bulges.middle.values[k] * x[bulges.middle.columns[k]];
      const double along = -a * hx * hx / 8, across = -b * hy * hy / 8, twist = c * hx * hy / 4;
      double least = HUGE_VAL;
      for (double expected : {along, across, along + across - twist, along + across + twist})
        least = std::min(least, std::abs(out.z - expected));
      most = std::max(most, std::hypot(least, out.x, out.y));
    }
    EXPECT_LT(most, 1e-15) << per_cell;
    // Where it bends up it stands out downward, by the edges along x or the diagonals.
    const int inside = s.patch_grid[0][1 + s.patch_grid_size[0][0]];
    const double diagonal = a * hx * hx / 8 + b * hy * hy / 8;
    EXPECT_NEAR(bulges.beside(inside, {0, 0, -1}, x),
                std::max({a * hx * hx / 8, diagonal + c * hx * hy / 4, diagonal - c * hx * hy / 4}), 1e-15);
    EXPECT_EQ(bulges.beside(inside, {0, 0, 1}, x) > 0, true);
  }
}

/// z = c x y: only the middle of four samples stands out. No diagonal of the triangles ends at every other sample.
TEST(Bulge, OfTwistIsSeenFromAllFourCorners) {
  const double c = 3;
  const Garment g = sheetOver(0.3, 0.2, 4, 0, 0, c, plainFabric());
  const Surface s = buildSurface(g, buildFreeMap(g), 3);
  const Bulges bulges = buildBulges(g, s, std::vector<int>{3});
  const std::vector<Vec3> x = positions(s.W, g);
  const double out = c * (0.3 / 12) * (0.2 / 9) / 4;
  const int with = s.patch_grid[0][1 + s.patch_grid_size[0][0]], without = with + 1;
  for (const double side : {1.0, -1.0}) {
    EXPECT_NEAR(bulges.beside(with, {0, 0, side}, x), out, 1e-15);
    EXPECT_NEAR(bulges.beside(without, {0, 0, side}, x), out, 1e-15);
    EXPECT_NEAR(bulges.beside(without, {0, 0, side}, x, false), 0, 1e-15);
  }
}

struct Lowered {
  double lowest = HUGE_VAL;  ///< point of the surface above the body, in the middle across [m]
  double bulge = 0, carried = 0;
};

/// Cloth hangs in a trough whose lowest line, x = 0, lies in the middle between samples, 2 mm above a body whose top is
/// at `top(x)`; this comes from below.
Lowered troughOn(const TriangleMesh& body, const auto& top) {
  Fabric fabric = sheetFabric();
  fabric.thickness_m = 0.3e-3;
  fabric.density_kg_per_m3 = 1000;
  Garment g = sheetOver(0.081, 0.06, 3, 80, 0, 0, fabric);
  for (Vec3& x : g.patches[0].points) x.z += 0.052;
  ModelOptions o;
  o.samples_per_cell = 3;
  const NurbsPatch& patch = g.patches[0];
  for (int j = 0; j < patch.v.count(); ++j)
    for (int i : {0, patch.u.count() - 1}) o.held_control_points.push_back(patch.index(i, j));
  Motion m(g, {{0, 0, -9.81}, 0.8}, {0, 0.3, 0.01, 1e-2, 400}, o, {{body, "body"}}, {}, {{0, 0, 0.02}});
  Frequency frequency;
  Lowered out;
  std::vector<Vec3> q(m.model->cloth->map().T.rows()), x;
  VelocityVerlet(*m.model, m.stage, {0.7, 1e-3}, frequency, m.work)
      .advance(0.15, m.state,
               [&](const State&, const State& after, const StepReport& r, const StepResult&, const Frequency&) {
                 out.carried -= r.momentum.obstacles.z;
                 m.model->cloth->map().T.multiply<Vec3>(after.p, q);
                 for (int i = 0; i <= 200; ++i) {
                   const SurfaceBasis basis = surfaceBasis(patch, i / 200.0, 0.5);
                   Vec3 at;
                   for (std::size_t k = 0; k < basis.columns.size(); ++k)
                     at += basis.values[0][k] * q[basis.columns[k]];
                   out.lowest = std::min(out.lowest, at.z - top(at.x) - 0.02 * after.time_s);
                 }
                 samplePositions(*m.model, after.p, x);
                 for (int s = 0; s < m.model->surface.size(); ++s)
                   if (out.carried != 0) out.bulge = std::max(out.bulge, m.model->bulges.beside(s, {0, 0, -1}, x));
               });
  std::printf("[ measured ] lowest point %.3f mm above the body, at most %.3f mm below the samples beside it\n",
              1e3 * out.lowest, 1e3 * out.bulge);
  EXPECT_GT(std::abs(out.carried), 1e-6);
  EXPECT_GT(out.bulge, 2 * fabric.thickness_m);
  EXPECT_LT(out.lowest, fabric.thickness_m);
  return out;
}

/// What stands out there is more than the thickness, and the surface stays out of the box.
TEST(Bulge, KeepsTheClothBetweenTheSamplesOutOfABody) {
  const Lowered on = troughOn(testing_shapes::box({0.1, 0.1, 0.05}), [](double) { return 0.05; });
  EXPECT_GT(on.lowest, -1e-5);
}

/// A ridge of 165 degrees under the lowest line: the samples beside it have their feet on its two faces, 0.6 mm lower.
TEST(Bulge, KeepsTheClothBetweenTheSamplesOutOfARidge) {
  const double slope = std::tan(M_PI / 24), w = 0.1, low = 0.05 - w * slope;
  const TriangleMesh roof{{{-w, -w, low}, {w, -w, low}, {0, -w, 0.05}, {-w, w, low}, {w, w, low}, {0, w, 0.05}},
                          {{0, 1, 2}, {3, 5, 4}, {0, 3, 4}, {0, 4, 1}, {0, 2, 5}, {0, 5, 3}, {1, 4, 5}, {1, 5, 2}}};
  const Lowered on = troughOn(roof, [&](double x) { return 0.05 - slope * std::abs(x); });
  EXPECT_GT(on.lowest, -1e-5);
}

}  // namespace
}  // namespace gambeson
