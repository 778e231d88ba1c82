/// A dart: a wedge is cut out of a flat panel, its legs are sewn to each other, and the panel becomes a cone.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/motion/sewing.hpp"
#include "unit/core/cloth/sewn_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// A square [-half, half]^2 without the wedge of the angle `dart` about the x axis, its tip in the middle.
Garment dartSheet(double half, double dart, int cells, const Fabric& fabric) {
  const double up = half * std::tan(dart / 2);
  Garment g = garmentOf({panelPatch(cells, cells, {-half, -half}, {half, half})}, {}, fabric);
  g.trims.resize(1);
  const std::vector<Vec2> corners{{0, 0}, {half, up}, {half, half}, {-half, half}, {-half, -half}, {half, -half}, {half, -up}};
  g.trims[0].loops = {polygon(corners)};
  g.sewn_seams = {{{loopPart(g, 0, 0, 0)}, {loopPart(g, 0, 0, 6, true)}}};
  return g;
}

/// The curvature that a circle of this radius about the tip encloses: 2 pi less what its curve turns by within the
/// surface, at the seam too (Gauss and Bonnet).
double enclosed(const Garment& g, const std::vector<Vec3>& q, double radius, double dart) {
  constexpr int n = 4000;
  double turned = 0;
  std::array<Vec3, 2> tangent, leg, normal;
  for (int k = 0; k <= n; ++k) {
    const double part = dart / 2 + (2 * kPi - dart) * k / n;
    const Vec2 d{std::cos(part), std::sin(part)}, uv{radius * d.x, radius * d.y};
    const SurfaceBasis b = surfaceBasis(g.patches[0], uv.x, uv.y);
    std::array<Vec3, 6> x{};
    for (std::size_t c = 0; c < b.columns.size(); ++c)
      for (std::size_t i = 0; i < 6; ++i) x[i] += b.values[i][c] * q[b.columns[c]];
    const Vec2 t{-radius * d.y, radius * d.x};
    const Vec3 along = t.x * x[1] + t.y * x[2];
    const Vec3 second = t.x * t.x * x[3] + t.y * t.y * x[4] + 2 * t.x * t.y * x[5] - uv.x * x[1] - uv.y * x[2];
    const Vec3 up = normalized(cross(x[1], x[2]));
    if (k == 0 || k == n) {
      tangent[k == 0 ? 0 : 1] = normalized(along);
      leg[k == 0 ? 0 : 1] = normalized(d.x * x[1] + d.y * x[2]);
      normal[k == 0 ? 0 : 1] = up;
    }
    const double weight = (k == 0 || k == n ? 0.5 : 1) * (2 * kPi - dart) / n;
    turned += weight * dot(up, cross(along, second)) / norm2(along);
  }
  // The angles between the curve and the seam on both sides; together pi where it goes on straight.
  const double a = std::acos(dot(tangent[0], leg[0])), c = std::acos(dot(-tangent[1], leg[1]));
  return 2 * kPi - turned - (kPi - a - c);
}

TEST(SewnDart, MakesACone) {
  const double half = 0.1, dart = kPi / 4;
  Fabric fabric = sheetFabric();
  fabric.law = LinearBending{{2e-6, 2e-6, 2e-6}};
  const Garment g = dartSheet(half, dart, 24, fabric);
  ModelOptions o;
  o.self_contact = false;
  Motion m(g, {{0, 0, 0}, 3}, {}, o);
  for (int i = 0; i < m.model->freeCount(); ++i) m.state.p[i].z = 0.2 * norm(m.state.p[i]);
  m.restart();
  State s = m.state;
  const double stable = 2 / largestFrequency(*m.model, m.stage, s, 80, m.work).largest_rad_per_s, dt = 0.5 * stable;
  double t = 0;
  int steps = 0;
  for (; t < 1.2; t += dt, ++steps) {
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    ASSERT_LT(r.momentum.error(), 1e-9 * r.momentum.scale);
  }
  std::vector<Vec3> q(m.model->cloth->points());
  m.model->cloth->map().T.multiply<Vec3>(m.state.p, q);
  for (const double radius : {0.4, 0.6, 0.8}) {
    const double found = enclosed(g, q, radius * half, dart);
    std::printf("dart of %.4f rad: a circle of %.2f of the half side encloses %.5f (%.2f %% off), gap %.2e cells, %d steps\n",
                dart, radius, found, 100 * (found / dart - 1), widestGap(*m.model, m.state.p), steps);
    EXPECT_NEAR(found, dart, 0.01 * dart);
  }
}

}  // namespace
}  // namespace gambeson
