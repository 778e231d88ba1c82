/// Sewn seams under self contact: both sides of a seam are one line, and what passes through beside it is found.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/contact/crossing.hpp"
#include "core/motion/sewing.hpp"
#include "unit/core/cloth/sewn_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr double kRadius = 0.08, kHeight = 0.12;
const ContactParameters kContact{1.2e-3, 0.2, 0.01, 1e-2, 400};

/// Two flat panels, whose cells do not match, sewn to a tube of two halves; they start on its circle.
Garment tube(double stiffness_N) {
  const double half = M_PI * kRadius;
  Garment g = garmentOf({panelPatch(12, 6, {0, 0}, {half, kHeight}), panelPatch(15, 7, {half, 0}, {2 * half, kHeight})},
                        {}, sheetFabric());
  for (const NurbsPatch& p : g.patches) {
    g.placed.emplace_back();
    for (const Vec3& X : p.points)
      g.placed.back().push_back({kRadius * std::cos(X.x / kRadius), kRadius * std::sin(X.x / kRadius), X.y});
  }
  for (Vec3& X : g.patches[1].points) X.z += 0.3;  // at rest they are apart
  for (const auto& [side, other] : {std::pair(Side::u1, Side::u0), std::pair(Side::u0, Side::u1)})
    g.sewn_seams.push_back({{sidePart(g, {0, side})}, {sidePart(g, {1, other})}, SeamHold::projected, stiffness_N});
  return g;
}

Motion placed(const Garment& g, bool self) {
  ModelOptions o;
  o.self_contact = self;
  Motion m(g, {{0, 0, 0}, 0.5}, kContact, o);
  std::vector<Vec3> at;
  for (const auto& patch : g.placed) at.insert(at.end(), patch.begin(), patch.end());
  for (int i = 0; i < m.model->freeCount(); ++i) m.state.p[i] = at[m.model->cloth->map().home[i]];
  m.restart();
  return m;
}

std::size_t crossings(const Motion& m) {
  std::vector<Vec3> x;
  samplePositions(*m.model, m.state.p, x);
  return findCrossings(m.model->collisions.mesh, x).size();
}

double stableStep(Motion& m) {
  State s = m.state;
  return 2 / largestFrequency(*m.model, m.stage, s, 80, m.work).largest_rad_per_s;
}

TEST(SewnContact, ATubeOfTwoPanelsMovesAsWithoutContact) {
  const Garment g = tube(1e-2);
  Motion with = placed(g, true), without = placed(g, false);
  const double dt = 0.4 * stableStep(with);
  int contacts = 0;
  for (int k = 0; k < 60; ++k) {
    const StepReport r = with.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    ASSERT_EQ(without.step(dt).failure, StepFailure::none);
    contacts += r.cloth_contacts + r.impacts + r.intersections;
    ASSERT_EQ(crossings(with), 0u) << k;
  }
  double off = 0, moved = 0;
  for (int i = 0; i < with.model->freeCount(); ++i) {
    off = std::max(off, norm(with.state.p[i] - without.state.p[i]));
    moved = std::max(moved, norm(with.state.p[i] - g.placed[0][0]));
  }
  EXPECT_EQ(contacts, 0);
  EXPECT_LT(off, 1e-12);
  EXPECT_GT(moved, 0.1);
}

TEST(SewnContact, WithoutTwinsTheSidesOfASeamRepelEachOther) {
  Motion m = placed(tube(1e-2), true);
  m.model->collisions.mesh.twins = {};
  EXPECT_GT(crossings(m), 0u);
  const StepReport r = m.step(0.4 * stableStep(m));
  EXPECT_TRUE(r.failure != StepFailure::none || r.cloth_contacts + r.impacts + r.intersections > 0) << r.why;
}

TEST(SewnContact, PanelsThatFoldAtTheirSeamsKeepApart) {
  // Free seams, and panels that spring back to flat while they are pressed on each other.
  const Garment g = tube(0);
  Motion m = placed(g, true);
  for (int i = 0; i < m.model->freeCount(); ++i) m.state.v[i] = {0, -1.5 * m.state.p[i].y / kRadius, 0};
  m.restart();
  const double dt = 0.3 * stableStep(m);
  int contacts = 0;
  double gap = 0, momentum = 0;
  for (int k = 0; k * dt < 0.08; ++k) {
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    contacts += r.cloth_contacts;
    gap = std::max(gap, widestGap(*m.model, m.state.p));
    momentum = std::max(momentum, r.momentum.error() / r.momentum.scale);
    if (k % 20 == 0) {
      ASSERT_EQ(crossings(m), 0u) << k * dt;
    }
  }
  double thick = 0;
  for (const Vec3& p : m.state.p) thick = std::max(thick, std::abs(p.y));
  std::printf("folded: %d contacts of cloth, gap %.3f cells, half as thick as %.1f mm\n", contacts, gap, 1e3 * thick);
  EXPECT_GT(contacts, 300);
  EXPECT_LT(gap, 0.02);
  EXPECT_LT(momentum, 1e-9);
  EXPECT_EQ(crossings(m), 0u);
}

TEST(SewnContact, ClothThatPassesThroughBesideASeamIsFound) {
  const Garment g = tube(0);
  Motion m = placed(g, true);
  std::vector<Vec3> x;
  samplePositions(*m.model, m.state.p, x);
  const ContactMesh& mesh = m.model->collisions.mesh;
  ASSERT_EQ(findCrossings(mesh, x).size(), 0u);
  ASSERT_GT(findCrossings(contactMesh(m.model->surface.size(), m.model->surface.triangles), x).size(), 0u)
      << "without twins the chords of both sides cross";
  // The second sample beside the seam at angle 0, half way up, is pushed through the other panel beside that seam.
  const auto [nu, nv] = m.model->surface.patch_grid_size[0];
  const int pushed = m.model->surface.patch_grid[0][2 + nu * (nv / 2)];
  const double angle = -1.5 * 2 * M_PI / 60;
  x[pushed] = {1.03 * kRadius * std::cos(angle), 1.03 * kRadius * std::sin(angle), x[pushed].z};
  const std::vector<Crossing> found = findCrossings(mesh, x);
  EXPECT_GE(found.size(), 2u);
  // And the run sees it: contours, which end where they reach the seam.
  EXPECT_FALSE(traceContours(mesh, x, found).empty());
}

TEST(SewnContact, EveryBorderOfASeamLiesBetweenTwins) {
  CutSheet sheet;
  sheet.hold = SeamHold::projected, sheet.apart = true;
  const Garment g = sheet.garment(sheetFabric());
  ModelOptions o;
  Motion m(g, {{0, 0, 0}, 0}, kContact, o);
  for (int i = 0; i < m.model->freeCount(); ++i) {
    const int home = m.model->cloth->map().home[i], first = g.patches[0].size();
    m.state.p[i] = home < first ? g.placed[0][home] : g.placed[1][home - first];
  }
  std::vector<Vec3> x;
  samplePositions(*m.model, m.state.p, x);
  const ContactMesh& mesh = m.model->collisions.mesh;
  const NurbsCurve cut = sheet.cut();
  int on = 0;
  for (int v = 0; v < mesh.vertex_count; ++v) {
    double from_cut = 1;
    for (int k = 0; k <= 2000; ++k) {
      const Vec2 c = curvePoint(cut, k / 2000.0).point;
      from_cut = std::min(from_cut, std::hypot(x[v].x - c.x, x[v].y - c.y));
    }
    if (from_cut > 2e-4) {
      EXPECT_TRUE(mesh.twins[v].empty()) << from_cut;
      continue;
    }
    ++on;
    const std::span<const int> twins = mesh.twins[v];
    ASSERT_FALSE(twins.empty()) << x[v].x << " " << x[v].y;
    double nearest = 1;
    for (const int a : twins)
      for (const int b : twins) {
        EXPECT_NE(m.model->surface.patch[a], m.model->surface.patch[v]);
        const Vec3 d = x[b] - x[a];
        const double t = norm2(d) > 0 ? std::clamp(dot(x[v] - x[a], d) / norm2(d), 0.0, 1.0) : 0;
        nearest = std::min(nearest, norm(x[v] - x[a] - t * d));
      }
    EXPECT_LT(nearest, 5e-4);  // what the chords of the S differ by
  }
  EXPECT_GT(on, 40);
}

}  // namespace
}  // namespace gambeson
