/// Darts: a panel with a seam whose sides meet within it is cut on through the tip, and becomes a cone when it is sewn;
/// elsewhere it is the panel in one piece.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <iterator>
#include <numeric>
#include <set>

#include "core/cloth/draft/areas.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/draft/sewn_length.hpp"
#include "core/cloth/draft/shared_points.hpp"
#include "core/error.hpp"
#include "core/motion/sewing.hpp"
#include "tryon/pattern/flat/panel_check.hpp"
#include "tryon/pattern/flat/panel_garment.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "unit/core/cloth/sewn_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Panel dartPolygon(const std::string& name, const std::vector<Vec2>& corners) {
  Panel p;
  p.name = name;
  for (const Vec2& c : corners) p.outline.push_back({"", c, StraightEdge{}});
  p.placement = PanelPlace{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  return p;
}

/// A square [-half, half]^2 with a dart whose tip is near the middle; it opens to the right, its middle leans by
/// `lean`.
FlatPattern dartPattern(double half, double dart, Vec2 tip, double lean) {
  FlatPattern p;
  p.name = "dart";
  const auto onSide = [&](double angle) {  // legs of one length
    return Vec2{tip.x + 0.95 * half * std::cos(angle), tip.y + 0.95 * half * std::sin(angle)};
  };
  p.panels = {dartPolygon("front", {tip,
                                    onSide(lean + dart / 2),
                                    {half, half},
                                    {-half, half},
                                    {-half, -half},
                                    {half, -half},
                                    onSide(lean - dart / 2)})};
  p.seams = {{"dart", {{0, 0, 0, 1}}, {{0, 6, 1, 0}}, SeamUse::dart}};
  checkPattern(p);
  return p;
}

/// The curvature that a circle about the tip encloses: 2 pi less what its curve turns by within the surface, at the
/// seam and at the cut too (Gauss and Bonnet).
double enclosedBy(const Garment& g, const std::vector<Vec3>& q, Vec2 tip, double radius, double from, double range) {
  constexpr int n = 4000;
  const NurbsCurve& cut = g.sewn_seams.back().a[0].curve;
  const double way = std::atan2(cut.points[1].y - cut.points[0].y, cut.points[1].x - cut.points[0].x);
  double middle = way - from;
  while (middle < 0) middle += 2 * kPi;
  double left = 2 * kPi - kPi * 2;
  for (const auto& [start, end] : {std::pair(from, from + middle), std::pair(from + middle, from + range)}) {
    const Vec2 inside{tip.x + radius * std::cos(0.5 * (start + end)), tip.y + radius * std::sin(0.5 * (start + end))};
    int piece = 0;
    for (int k = 0; k < 2; ++k) {
      const NurbsPatch& patch = g.patches[k];
      if (inside.x > patch.u.front() && inside.x < patch.u.back() && inside.y > patch.v.front() &&
          inside.y < patch.v.back() && isKept(patch, g.trims[k], inside))
        piece = k;
    }
    const NurbsPatch& patch = g.patches[piece];
    const int first = controlOffsets(g)[piece];
    for (int k = 0; k <= n; ++k) {
      const double at = start + (end - start) * k / n;
      const Vec2 d{std::cos(at), std::sin(at)};
      const Vec2 uv{tip.x + radius * d.x, tip.y + radius * d.y};
      const SurfaceBasis b = surfaceBasis(patch, uv.x, uv.y);
      std::array<Vec3, 6> x{};
      for (std::size_t c = 0; c < b.columns.size(); ++c)
        for (std::size_t i = 0; i < 6; ++i) x[i] += b.values[i][c] * q[static_cast<std::size_t>(first + b.columns[c])];
      const Vec2 t{-radius * d.y, radius * d.x};
      const Vec3 along = t.x * x[1] + t.y * x[2];
      const Vec3 second =
          t.x * t.x * x[3] + t.y * t.y * x[4] + 2 * t.x * t.y * x[5] - radius * d.x * x[1] - radius * d.y * x[2];
      const double weight = (k == 0 || k == n ? 0.5 : 1) * (end - start) / n;
      left -= weight * dot(normalized(cross(x[1], x[2])), cross(along, second)) / norm2(along);
      if (k == 0 || k == n)
        left += std::acos(dot((k == 0 ? 1.0 : -1.0) * normalized(along), normalized(d.x * x[1] + d.y * x[2])));
    }
  }
  return left;
}

/// Sews the dart without gravity in air that damps, until it rests; looks at circles and at the gap in every step.
void sewCone(double dart, Vec2 tip, double lean, double cell_m) {
  const double half = 0.1;
  Garment g = panelGarment(dartPattern(half, dart, tip, lean), {cell_m, 2});
  ASSERT_EQ(g.patches.size(), 2u);
  Fabric fabric = sheetFabric();
  fabric.law = LinearBending{{2e-5, 2e-5, 2e-5}};
  for (double* modulus : {&fabric.young_weft_Pa, &fabric.young_warp_Pa, &fabric.shear_Pa}) *modulus *= 10;  // 350 N/m
  g.fabric = fabric;
  ModelOptions o;
  o.self_contact = false;
  shapes::Motion m(g, {{0, 0, 0}, 3}, {}, o);
  // Near the cone: each piece by its own angles, on beyond its sides.
  const NurbsCurve& cut = g.sewn_seams.back().a[0].curve;
  // Parameters run along the dart.
  const Vec2 at_uv{std::cos(lean) * tip.x + std::sin(lean) * tip.y, -std::sin(lean) * tip.x + std::cos(lean) * tip.y};
  const double from = lean + dart / 2, range = 2 * kPi - dart, share = range / (2 * kPi);
  double middle = std::atan2(cut.points[1].y - cut.points[0].y, cut.points[1].x - cut.points[0].x) - dart / 2;
  if (middle < 0) middle += 2 * kPi;
  const std::vector<int>& home = m.model->cloth->map().home;
  for (int i = 0; i < m.model->freeCount(); ++i) {
    const Vec3 x = m.state.p[i];
    const double r = std::hypot(x.x - tip.x, x.y - tip.y),
                 mean = home[i] < g.patches[0].size() ? 0.5 * middle : 0.5 * (middle + range);
    const double at = mean + std::remainder(std::atan2(x.y - tip.y, x.x - tip.x) - from - mean, 2 * kPi);
    m.state.p[i] = {tip.x + share * r * std::cos(at / share), tip.y + share * r * std::sin(at / share),
                    r * std::sqrt(1 - share * share)};
  }
  m.restart();
  State s = m.state;
  const double dt = 0.8 / largestFrequency(*m.model, m.stage, s, 80, m.work).largest_rad_per_s;
  double widest_closed = 0, closed_at = -1;
  for (double t = 0; t < 0.25; t += dt) {
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    ASSERT_LT(r.momentum.error(), 1e-9 * std::max(r.momentum.scale, 1e-6));
    const double gap = widestGap(*m.model, m.state.p);
    if (closed_at < 0 && gap < 0.01) closed_at = t;
    if (closed_at >= 0) widest_closed = std::max(widest_closed, gap);
  }
  std::vector<Vec3> q(m.model->cloth->points());
  m.model->cloth->map().T.multiply<Vec3>(m.state.p, q);
  for (const double radius :
       {0.3, 0.4, 0.5, 0.6, 0.7, 0.8}) {  // tangents are those of splines: some cells from the tip
    const double found = enclosedBy(g, q, at_uv, radius * half, dart / 2, range);
    std::printf("dart of %.4f rad: a circle of %.2f of the half side (%.1f cells) encloses %+.2f %%\n", dart, radius,
                radius * half / cell_m, 100 * (found / dart - 1));
    if (radius * half > 5.5 * cell_m) {
      EXPECT_NEAR(found, dart, 0.01 * dart) << radius;
    }
  }
  std::printf("closed after %.3f s, widest gap then %.3f %% of a cell, step %.1f us\n", closed_at, 100 * widest_closed,
              1e6 * dt);
  EXPECT_GE(closed_at, 0);
  EXPECT_LT(widest_closed, 0.01);
}

/// A panel of 40 x 50 cm with two darts at its top, one at its left side and one inside of it, each of another kind.
FlatPattern fourDarts() {
  FlatPattern p;
  p.name = "four";
  Panel front = dartPolygon("front", {{0, 0},
                                      {0.4, 0},
                                      {0.4, 0.5},
                                      {0.32, 0.5},  // 3: a straight dart
                                      {0.3, 0.38},
                                      {0.28, 0.5},
                                      {0.2, 0.5},  // 6: one edge there and back
                                      {0, 0.5},
                                      {0, 0.22},  // 8: a dart that opens to the left
                                      {0.12, 0.205},
                                      {0, 0.19}});
  front.outline[6].curve = PolylineEdge{{{0.13, 0.5}, {0.11, 0.36}, {0.09, 0.5}}};
  for (const Vec2& c : {Vec2{0.22, 0.15}, Vec2{0.205, 0.22}, Vec2{0.22, 0.3}, Vec2{0.23, 0.22}}) {
    if (front.cutouts.empty()) front.cutouts.emplace_back();
    front.cutouts[0].push_back({"", c, StraightEdge{}});
  }
  p.panels = {front};
  const MeasuredCurve top(curveOf(front, 6));
  const double l = top.length_m(), down = std::hypot(0.02, 0.14), tip = (0.07 + down) / l;
  p.seams = {{"right", {{0, 3, 0, 1}}, {{0, 4, 1, 0}}, SeamUse::dart},
             {"left", {{0, 6, 0.07 / l, tip}}, {{0, 6, (0.07 + 2 * down) / l, tip}}, SeamUse::dart},
             {"side", {{0, 8, 0, 1}}, {{0, 9, 1, 0}}, SeamUse::dart},
             {"fish", {{0, 11, 0, 1}, {0, 12, 0, 1}}, {{0, 14, 1, 0}, {0, 13, 1, 0}}, SeamUse::dart}};
  checkPattern(p);
  return p;
}

TEST(Dart, PiecesHaveTheAreaAndTheSeamsOfThePanel) {
  const FlatPattern p = fourDarts();
  const Garment g = panelGarment(p, {0.01, 2});
  EXPECT_EQ(g.patches.size(), 6u);  // the cut of the side dart runs through the one inside
  const std::vector<double> areas = controlAreas(g);
  EXPECT_NEAR(std::accumulate(areas.begin(), areas.end(), 0.0), areaOf(p.panels[0]), 1e-9);
  for (std::size_t k = 0; k < p.seams.size(); ++k) {
    EXPECT_NEAR(lengthOf(g, g.sewn_seams[k].a), lengthOf(p, p.seams[k].a), 1e-9);
    EXPECT_NEAR(lengthOf(g, g.sewn_seams[k].b), lengthOf(p, p.seams[k].b), 1e-9);
  }
  // Sides of a dart are of different pieces, but where a cut ends on them.
  for (std::size_t k = 0; k < p.seams.size(); ++k)
    for (const double s : {0.05, 0.95}) {
      const SewnLength a(g, g.sewn_seams[k].a, ""), b(g, g.sewn_seams[k].b, "");
      if (k == 3 || s > 0.5) {
        EXPECT_NE(a.at(s).patch, b.at(s).patch) << k;
      }
    }
  const SewnRows rows = buildSewnRows(g, SeamHold::projected);
  std::vector<int> of_seam(g.sewn_seams.size(), 0);
  for (const int k : rows.seam) ++of_seam[static_cast<std::size_t>(k)];
  for (std::size_t k = 0; k < p.seams.size(); ++k) EXPECT_GT(of_seam[k], 10) << k;
}

/// Whatever the free points do: away from the tips the pieces are one smooth sheet.
TEST(Dart, PiecesGoOnSmoothlyAcrossTheirCuts) {
  const FlatPattern p = fourDarts();
  const double cell = 0.01;
  const Garment g = panelGarment(p, {cell, 2});
  const FreeMap map = buildFreeMap(g);
  std::vector<Vec3> free(map.home.size()), q(static_cast<std::size_t>(controlOffsets(g).back()));
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = {std::sin(1.3 * i), std::cos(2.1 * i), std::sin(0.7 * i)};
  map.T.multiply<Vec3>(free, q);
  const std::vector<Vec2> tips{{0.3, 0.38}, {0.11, 0.36}, {0.12, 0.205}, {0.22, 0.15}, {0.22, 0.3}};
  int looked = 0, apart = 0;
  for (std::size_t s = p.seams.size(); s < g.sewn_seams.size(); ++s) {
    const SewnPart &a = g.sewn_seams[s].a[0], &b = g.sewn_seams[s].b[0];
    for (int k = 1; k < 40; ++k) {
      const Vec2 at = curvePoint(a.curve, k / 40.0).point;
      const auto derivatives = [&](int patch) {
        const SurfaceBasis basis = surfaceBasis(g.patches[static_cast<std::size_t>(patch)], at.x, at.y);
        std::array<Vec3, 3> x{};
        for (std::size_t c = 0; c < basis.columns.size(); ++c)
          for (std::size_t i = 0; i < 3; ++i)
            x[i] += basis.values[i][c] *
                    q[static_cast<std::size_t>(controlOffsets(g)[static_cast<std::size_t>(patch)] + basis.columns[c])];
        return x;
      };
      const auto left = derivatives(a.patch), right = derivatives(b.patch);
      double near = 1e300;
      for (const Vec2& tip : tips) near = std::min(near, std::hypot(at.x - tip.x, at.y - tip.y));
      ++looked;
      const double gap = norm(left[0] - right[0]);
      if (gap > 1e-9) ++apart;
      if (near < 3.5 * cell || at.x < 0.12) continue;  // the first cuts end on the side's dart, the last at a cut's end
      EXPECT_LT(gap, 1e-12) << s << " at " << at.x << ", " << at.y;
      for (std::size_t i = 1; i < 3; ++i) EXPECT_LT(norm(left[i] - right[i]), 1e-9) << s;
    }
  }
  EXPECT_GT(apart, 5);  // near the tips both sides have points of their own
  EXPECT_LT(apart, looked / 2);
}

/// The front of a bodice: the cut of the waist dart ends on that of the bust dart, less than a cell above its tip.
FlatPattern bustAndWaistDart() {
  FlatPattern p;
  p.name = "bodice";
  p.panels = {dartPolygon("front", {{-0.108, 0},
                                    {-0.096, 0.128},  // 1: the waist dart's tip
                                    {-0.084, 0},
                                    {0, 0},
                                    {0, 0.4},
                                    {-0.26, 0.4},
                                    {-0.26, 0.18},
                                    {-0.13, 0.16},  // 7: the bust dart's
                                    {-0.26, 0.14},
                                    {-0.25, 0}})};
  p.seams = {{"bust", {{0, 6, 0, 1}}, {{0, 7, 1, 0}}, SeamUse::dart},
             {"waist", {{0, 0, 0, 1}}, {{0, 1, 1, 0}}, SeamUse::dart}};
  checkPattern(p);
  return p;
}

/// Where cuts meet near a tip no third piece holds both sides of a dart together.
TEST(Dart, SidesShareNoPointWhereCutsMeetNearATip) {
  for (const double cell : {0.04, 0.03, 0.02, 0.01}) {
    const FlatPattern p = bustAndWaistDart();
    const Garment g = panelGarment(p, {cell, 2});
    ASSERT_EQ(g.patches.size(), 3u);
    const std::vector<int> owner = sharedOwners(g), first = controlOffsets(g);
    const auto points = [&](const SewnPoint& at) {
      std::set<int> out;
      const SurfaceBasis basis = surfaceBasis(g.patches[static_cast<std::size_t>(at.patch)], at.uv.x, at.uv.y);
      for (std::size_t k = 0; k < basis.columns.size(); ++k)
        if (basis.values[0][k] > 1e-12)
          out.insert(owner[static_cast<std::size_t>(first[static_cast<std::size_t>(at.patch)] + basis.columns[k])]);
      return out;
    };
    int shared = 0;
    for (std::size_t c = 0; c < owner.size(); ++c) shared += owner[c] != static_cast<int>(c);
    EXPECT_GT(shared, cell < 0.015 ? 20 : 2) << cell;  // away from the tips
    for (std::size_t k = 0; k < p.seams.size(); ++k) {
      const SewnLength a(g, g.sewn_seams[k].a, ""), b(g, g.sewn_seams[k].b, "");
      for (int i = 0; i <= 40; ++i) {
        const std::set<int> left = points(a.at(i / 40.0)), right = points(b.at(i / 40.0));
        std::vector<int> both;
        std::set_intersection(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(both));
        EXPECT_TRUE(both.empty()) << p.seams[k].name << " at " << i / 40.0 << ", cell " << cell;
      }
    }
  }
}

/// What cannot be parted is said.
TEST(Dart, ATipAtACutoutWithOneDartIsRefused) {
  FlatPattern p = fourDarts();
  p.seams = {{"half", {{0, 11, 1, 0}}, {{0, 14, 0, 1}}, SeamUse::dart}};
  try {
    panelGarment(p, {0.01, 2});
    ADD_FAILURE() << "one tip at a cutout";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "panels[0]");
    EXPECT_NE(e.reason().find("tip of seam \"half\""), std::string::npos) << e.reason();
  }
}

/// An opening that is open is held by its buttons alone; a dart that is open is not cut on.
TEST(PanelOpening, IsHeldByItsButtons) {
  FlatPattern p = dartPattern(0.1, kPi / 4, {0.0013, 0.0021}, 0);
  p.seams[0].use = SeamUse::opening;
  p.seams[0].open = true;
  Garment g = panelGarment(p, {0.01, 2});
  EXPECT_EQ(g.patches.size(), 1u);
  ASSERT_EQ(g.sewn_seams.size(), 1u);
  EXPECT_EQ(g.sewn_seams[0].hold, SeamHold::open);
  EXPECT_TRUE(buildSewnRows(g, SeamHold::projected).empty());
  p.seams[0].buttons = 3;
  g = panelGarment(p, {0.01, 2});
  ASSERT_EQ(g.sewn_seams.size(), 4u);
  const SewnRows rows = buildSewnRows(g, SeamHold::projected);
  for (const int seam : rows.seam) EXPECT_GE(seam, 1);
  const double leg = lengthOf(p, p.seams[0].a);
  for (std::size_t k = 1; k < 4; ++k) {  // a centimetre each, about 1/6, 1/2 and 5/6 of the way
    EXPECT_NEAR(lengthOf(g, g.sewn_seams[k].a), 0.01, 1e-9);
    const Vec2 middle = SewnLength(g, g.sewn_seams[k].a, "").at(0.5).uv;
    EXPECT_NEAR(std::hypot(middle.x - 0.0013, middle.y - 0.0021), (2 * static_cast<double>(k) - 1) / 6 * leg, 1e-9);
  }
}

/// Two darts of a back that lean on each other by 0.05 rad (3 degrees), as the waist darts of a torso do: the grid runs
/// along the longer one, and the other lies across the cells.
TEST(Dart, OneThatLeansOnTheGridCloses) {
  FlatPattern p;
  p.name = "two";
  p.panels = {dartPolygon("back", {{0, 0},
                                   {0.3, 0},
                                   {0.3, 0.3},
                                   {0.23, 0.3},  // 3: a dart of 11 cm that leans
                                   {0.22 + 0.11 * std::sin(0.05), 0.3 - 0.11},
                                   {0.21, 0.3},
                                   {0.09, 0.3},  // 6: one of 12 cm along the grain
                                   {0.08, 0.18},
                                   {0.07, 0.3},
                                   {0, 0.3}})};
  p.seams = {{"short", {{0, 3, 0, 1}}, {{0, 4, 1, 0}}, SeamUse::dart},
             {"long", {{0, 6, 0, 1}}, {{0, 7, 1, 0}}, SeamUse::dart}};
  checkPattern(p);
  Garment g = panelGarment(p, {0.04, 2});
  g.fabric = sheetFabric();
  ModelOptions o;
  o.self_contact = false;
  shapes::Motion m(g, {{0, 0, 0}, 3}, {}, o);
  for (Vec3& x : m.state.p) x.z += 2e-3 * std::sin(20 * x.x) * std::sin(15 * x.y);
  m.restart();
  State s = m.state;
  const double dt = 0.8 / largestFrequency(*m.model, m.stage, s, 80, m.work).largest_rad_per_s;
  for (double t = 0; t < 0.5; t += dt) {
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
  }
  const double gap = widestGap(*m.model, m.state.p);
  std::printf("widest gap %.3f %% of a cell\n", 100 * gap);
  EXPECT_LT(gap, 0.01);
}

TEST(Dart, MakesAConeAlongTheGrain) { sewCone(kPi / 4, {0.0013, 0.0021}, 0, 0.2 / 24); }
TEST(Dart, MakesAConeThatLeansOnTheGrain) { sewCone(kPi / 4, {0.0013, 0.0021}, 0.1, 0.2 / 24); }

}  // namespace
}  // namespace gambeson
