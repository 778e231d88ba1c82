/// A dart: a wedge is cut out of a flat panel, its legs are sewn to each other, and the panel becomes a cone. Where a
/// wedge is narrower than three cells both legs move with the same control points, and the tip is blunt; a panel that
/// is cut on through the tip has its own control points on both sides.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/motion/sewing.hpp"
#include "unit/core/cloth/sewn_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// A square [-half, half]^2 without the wedge of the angle `dart` about the x axis, its tip in the middle. Cut in two
/// along the other half of that axis where `cut`; else one panel.
Garment dartSheet(double half, double dart, int cells, bool cut, const Fabric& fabric) {
  const double up = half * std::tan(dart / 2);
  Garment g;
  if (!cut) {
    g = garmentOf({panelPatch(cells, cells, {-half, -half}, {half, half})}, {}, fabric);
    const std::vector<Vec2> corners{{0, 0},         {half, up},    {half, half}, {-half, half},
                                    {-half, -half}, {half, -half}, {half, -up}};
    g.trims.resize(1);
    g.trims[0].loops = {polygon(corners)};
    g.sewn_seams = {{{loopPart(g, 0, 0, 0)}, {loopPart(g, 0, 0, 6, true)}}};
  } else {
    g = garmentOf({panelPatch(cells, cells / 2, {-half, 0}, {half, half}),
                   panelPatch(cells + 1, cells / 2 + 1, {-half, -half}, {half, 0})},
                  {}, fabric);
    g.trims.resize(2);
    g.trims[0].loops = {polygon(std::vector<Vec2>{{0, 0}, {half, up}, {half, half}, {-half, half}, {-half, 0}})};
    g.trims[1].loops = {polygon(std::vector<Vec2>{{0, 0}, {-half, 0}, {-half, -half}, {half, -half}, {half, -up}})};
    g.sewn_seams = {{{loopPart(g, 0, 0, 0)}, {loopPart(g, 1, 0, 4, true)}},
                    {{loopPart(g, 0, 0, 4, true)}, {loopPart(g, 1, 0, 0)}}};
    g.sewn_seams[1].stiffness_N = 1e-3;
  }
  for (SewnSeam& seam : g.sewn_seams) seam.rows_per_cell = 1;
  return g;
}

/// The curvature that a circle of this radius about the tip encloses: 2 pi less what its curve turns by within the
/// surface, at the seams too (Gauss and Bonnet).
double enclosed(const Garment& g, const std::vector<Vec3>& q, double radius, double dart) {
  constexpr int n = 4000;
  const int arcs = static_cast<int>(g.patches.size());
  double left = 2 * kPi - kPi * arcs;  // each arc's ends with the seams: a straight line has pi
  for (int arc = 0; arc < arcs; ++arc) {
    const double range = (2 * kPi - dart) / arcs, from = dart / 2 + arc * range;
    const int first = controlOffsets(g)[static_cast<std::size_t>(arc)];
    for (int k = 0; k <= n; ++k) {
      const double at = from + range * k / n;
      const NurbsPatch& patch = g.patches[static_cast<std::size_t>(arc)];
      const Vec2 d{std::cos(at), std::sin(at)};
      const Vec2 uv{radius * d.x, std::clamp(radius * d.y, patch.v.front(), patch.v.back())};
      const SurfaceBasis b = surfaceBasis(patch, uv.x, uv.y);
      std::array<Vec3, 6> x{};
      for (std::size_t c = 0; c < b.columns.size(); ++c)
        for (std::size_t i = 0; i < 6; ++i) x[i] += b.values[i][c] * q[static_cast<std::size_t>(first + b.columns[c])];
      const Vec2 t{-radius * d.y, radius * d.x};
      const Vec3 along = t.x * x[1] + t.y * x[2];
      const Vec3 second = t.x * t.x * x[3] + t.y * t.y * x[4] + 2 * t.x * t.y * x[5] - uv.x * x[1] - uv.y * x[2];
      const double weight = (k == 0 || k == n ? 0.5 : 1) * range / n;
      left -= weight * dot(normalized(cross(x[1], x[2])), cross(along, second)) / norm2(along);
      if (k == 0 || k == n)
        left += std::acos(dot((k == 0 ? 1.0 : -1.0) * normalized(along), normalized(d.x * x[1] + d.y * x[2])));
    }
  }
  return left;
}

/// Sews the dart of a flat panel, without gravity in air that damps, until it rests.
void sewDart(bool cut, double least_radius) {
  const double half = 0.1, dart = kPi / 4;
  Fabric fabric = sheetFabric();
  fabric.law = LinearBending{{2e-5, 2e-5, 2e-5}};
  const Garment g = dartSheet(half, dart, 24, cut, fabric);
  ModelOptions o;
  o.self_contact = false;
  Motion m(g, {{0, 0, 0}, 3}, {}, o);
  for (int i = 0; i < m.model->freeCount(); ++i) m.state.p[i].z = 0.2 * norm(m.state.p[i]);
  m.restart();
  State s = m.state;
  const double dt = 0.8 / largestFrequency(*m.model, m.stage, s, 80, m.work).largest_rad_per_s;
  for (double t = 0; t < 1.2; t += dt) {
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    ASSERT_LT(r.momentum.error(), 1e-9 * r.momentum.scale);
  }
  std::vector<Vec3> q(m.model->cloth->points());
  m.model->cloth->map().T.multiply<Vec3>(m.state.p, q);
  for (const double radius : {0.4, 0.6, 0.7, 0.8}) {
    if (radius < least_radius) continue;
    const double found = enclosed(g, q, radius * half, dart);
    std::printf("dart of %.4f rad, %d panels: a circle of %.2f of the half side encloses %+.2f %%, gap %.2e cells\n",
                dart, cut ? 2 : 1, radius, 100 * (found / dart - 1), widestGap(*m.model, m.state.p));
    EXPECT_NEAR(found, dart, 0.01 * dart);
  }
}

TEST(SewnDart, MakesACone) { sewDart(true, 0.4); }
TEST(SewnDart, MakesAConeOfOnePanelAwayFromItsTip) { sewDart(false, 0.6); }

}  // namespace
}  // namespace gambeson
