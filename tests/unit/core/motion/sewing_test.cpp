/// Sewn seams in explicit steps: momenta, gaps, the length of steps, against cloth in one piece, under contact.
#include "core/motion/sewing.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/cloth/draft/join_garments.hpp"
#include "core/motion/held_motion.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "unit/core/cloth/sewn_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

CutSheet sewnSheet() {
  CutSheet sheet;
  sheet.hold = SeamHold::projected;
  sheet.apart = true;
  return sheet;
}

/// Starts where the panels were placed; `held`: the edge x = 0.
Motion startOf(const Garment& g, const Environment& e, bool held, const ContactParameters& contact = {},
               std::vector<Obstacle> obstacles = {}, std::vector<Placement> at = {}) {
  ModelOptions o;
  o.self_contact = false;
  if (held)
    for (int j = 0; j < g.patches[0].v.count(); ++j) o.held_control_points.push_back(g.patches[0].index(0, j));
  Motion m(g, e, contact, o, std::move(obstacles), std::move(at));
  std::vector<Vec3> placed;
  for (const auto& patch : g.placed) placed.insert(placed.end(), patch.begin(), patch.end());
  if (!placed.empty())
    for (int i = 0; i < m.model->freeCount(); ++i) m.state.p[i] = placed[m.model->cloth->map().home[i]];
  m.restart();
  return m;
}

/// A fabric that keeps its shape for a while.
Fabric stiffFabric() {
  Fabric f = sheetFabric();
  f.law = LinearBending{{2e-4, 2e-4}};
  return f;
}

double stableStep(Motion& m) {
  State s = m.state;
  return 2 / largestFrequency(*m.model, m.stage, s, 80, m.work).largest_rad_per_s;
}

Vec3 edgePoint(const Motion& m, const Garment& g, int patch, Vec2 uv) {
  std::vector<Vec3> q(m.model->cloth->points());
  m.model->cloth->map().T.multiply<Vec3>(m.state.p, q);
  return pointOf(g, patch, uv, q);
}

TEST(Sewing, AFreeSheetKeepsItsMomenta) {
  CutSheet sheet = sewnSheet();
  sheet.stiffness_N = 1e-3;
  const Garment g = sheet.garment(sheetFabric());
  Motion m = startOf(g, {{0, 0, 0}, 0}, false);
  for (int i = 0; i < m.model->freeCount(); ++i) {
    const Vec3 x = m.state.p[i] / 0.3;
    m.state.v[i] = Vec3{0.3 * x.y, 0.4 * std::sin(3 * x.x), 0.8 * std::cos(5 * x.x) * x.y} + Vec3{0.2, 0.1, -0.1};
  }
  const double dt = 0.4 * stableStep(m);
  m.step(dt);  // the first takes away what parts the panels
  const auto momenta = [&](Vec3& linear, Vec3& angular, double& size) {
    linear = angular = {};
    size = 0;
    for (int i = 0; i < m.model->freeCount(); ++i) {
      const Vec3 p = m.model->mass_kg[i] * m.state.v[i];
      linear += p, angular += cross(m.state.p[i], p), size += norm(p);
    }
  };
  Vec3 l0, a0, l1, a1;
  double size = 0, worst = 0, gap = 0, row = 0;
  momenta(l0, a0, size);
  std::vector<Vec3> rows;
  for (int k = 0; k < 400; ++k) {
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    gap = std::max(gap, widestGap(*m.model, m.state.p));
    m.model->sewing.gaps(m.state.p, rows);
    for (const Vec3& g_k : rows) row = std::max(row, norm(g_k));
  }
  momenta(l1, a1, size);
  std::printf("free: momentum %.1e, linear %.1e, angular %.1e, rows %.1e m, gap %.2e cells\n", worst,
              norm(l1 - l0) / size, norm(a1 - a0) / (0.3 * size), row, gap);
  EXPECT_LT(worst, 1e-9);
  EXPECT_LT(norm(l1 - l0), 1e-9 * size);
  EXPECT_LT(norm(a1 - a0), 1e-9 * 0.3 * size);
  EXPECT_LT(row, 1e-13);
  EXPECT_LT(gap, 0.01);
}

TEST(Sewing, MomentumBalancesWithSupportsDragAndTwoFabrics) {
  CutSheet sheet = sewnSheet();
  Garment g = sheet.garment(sheetFabric());
  Fabric heavy = sheetFabric();
  heavy.density_kg_per_m3 *= 3;
  g.other_fabrics = {heavy};
  g.fields.resize(2);
  g.fields[1].material = PatchField{0, 1, 1, {1}};
  // The seam reaches the held edge: its first points are held.
  ModelOptions o;
  o.self_contact = false;
  for (int k = 0; k < g.patches[1].size(); ++k)
    if (g.placed[1][k].y < 1e-9) o.held_control_points.push_back(g.patches[0].size() + k);
  Motion m(g, {{0, 0, -9.81}, 0.8}, {}, o);
  std::vector<Vec3> placed = g.placed[0];
  placed.insert(placed.end(), g.placed[1].begin(), g.placed[1].end());
  for (int i = 0; i < m.model->freeCount(); ++i) m.state.p[i] = placed[m.model->cloth->map().home[i]];
  m.stage.wind = {0.5, 1, 0.3};
  m.restart();
  const double dt = 0.4 * stableStep(m);
  double worst = 0, held = 0;
  for (int k = 0; k < 300; ++k) {
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    for (const int i : m.model->held_points) held = std::max(held, norm(m.work.sewn_force[i]));
  }
  std::printf("held, dragged: momentum %.1e, seam on held points up to %.1e N\n", worst, held);
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(held, 1e-4);
}

TEST(Sewing, NoStepIsShorterThanThatOfTheUnsewn) {
  for (const double stiffness : {0.0, 1e-3}) {
    CutSheet sheet = sewnSheet();
    sheet.stiffness_N = stiffness;
    Motion sewn = startOf(sheet.garment(sheetFabric()), {{0, 0, 0}, 0}, false);
    sheet.hold = SeamHold::open;
    Motion open = startOf(sheet.garment(sheetFabric()), {{0, 0, 0}, 0}, false);
    std::printf("stable step over that of the unsewn panels: %.4f (spring %g N)\n", stableStep(sewn) / stableStep(open),
                stiffness);
    EXPECT_GT(stableStep(sewn), 0.9 * stableStep(open));
    if (stiffness == 0) {
      EXPECT_GT(stableStep(sewn), 0.999 * stableStep(open));
    }
  }
}

TEST(Sewing, AnyNumberOfThreadsGivesTheSameBits) {
  std::vector<State> states;
  const int threads = omp_get_max_threads();
  for (const int count : {1, 3}) {
    omp_set_num_threads(count);
    Motion m = startOf(sewnSheet().garment(sheetFabric()), {{0, 0, -9.81}, 0.5}, true);
    for (int k = 0; k < 100; ++k) ASSERT_EQ(m.step(2e-4).failure, StepFailure::none);
    states.push_back(m.state);
  }
  omp_set_num_threads(threads);
  for (std::size_t i = 0; i < states[0].p.size(); ++i) {
    EXPECT_EQ(states[0].p[i], states[1].p[i]);
    EXPECT_EQ(states[0].v[i], states[1].v[i]);
  }
}

/// How the free edge of a sheet that swings down from its held edge moves, sewn and in one piece.
double swingError(int cells, double seconds, double& gap) {
  CutSheet sheet = sewnSheet();
  sheet.cells = cells;
  const Fabric fabric = stiffFabric();
  const double h = sheet.width / cells;
  sheet.stiffness_N = 10 * 2e-4 / h;
  const Garment g = sheet.garment(fabric), one = sheet.whole(fabric, cells + cells / 3 + 1);
  const Environment e{{0, 0, -9.81}, 0.1};
  Motion sewn = startOf(g, e, true), whole = startOf(one, e, true);
  const double dt = 0.5 * std::min(stableStep(sewn), stableStep(whole));
  const int steps = static_cast<int>(std::ceil(seconds / dt));
  double error = 0, way = 0;
  gap = 0;
  for (int k = 1; k <= steps; ++k) {
    EXPECT_EQ(sewn.step(seconds / steps).failure, StepFailure::none);
    EXPECT_EQ(whole.step(seconds / steps).failure, StepFailure::none);
    gap = std::max(gap, widestGap(*sewn.model, sewn.state.p));
    if (k % 20 != 0 && k != steps) continue;
    for (const double y : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const Vec2 at{sheet.length, y * sheet.width};
      const Vec3 a = edgePoint(sewn, g, 1, at), b = edgePoint(whole, one, 0, at);
      error = std::max(error, norm(a - b));
      way = std::max(way, norm(b - Vec3{at.x, at.y, 0}));
    }
  }
  std::printf("swing of %.2f s, %d cells: edge goes %.4f m, off by %.3f %%; gap %.2e cells; %d steps\n", seconds, cells,
              way, 100 * error / way, gap, steps);
  return error / way;
}

TEST(Sewing, ASheetCutByAnSSwingsLikeTheWholeOne) {
  double gap = 0, finer_gap = 0;
  const double error = swingError(8, 0.25, gap), finer = swingError(16, 0.25, finer_gap);
  EXPECT_LT(error, 0.01);
  EXPECT_LT(finer, 0.01);
  EXPECT_LT(gap, 0.01);
  EXPECT_LT(finer_gap, 0.01);
}

TEST(Sewing, PanelsThatLieApartAreClosed) {
  CutSheet sheet = sewnSheet();
  const Garment g = sheet.garment(sheetFabric());
  Motion m = startOf(g, {{0, 0, 0}, 1}, false);
  for (int i = 0; i < m.model->freeCount(); ++i)
    if (m.model->cloth->map().home[i] >= g.patches[0].size()) m.state.p[i] += Vec3{0.02, 0, 0.01};
  m.restart();
  std::vector<Vec3> rows;
  const auto widest = [&] {
    double most = 0;
    m.model->sewing.gaps(m.state.p, rows);
    for (const Vec3& r : rows) most = std::max(most, norm(r));
    return most;
  };
  const double before = widest(), dt = 0.4 * stableStep(m);
  double worst = 0, fastest = 0;
  for (int k = 0; k * dt < 0.4; ++k) {
    const double start = widest();
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    fastest = std::max(fastest, (start - widest()) / dt);
  }
  EXPECT_NEAR(before, std::hypot(0.02, 0.01), 1e-12);
  EXPECT_LT(widest(), 1e-4);
  EXPECT_LT(fastest, 0.2501);
  EXPECT_LT(worst, 1e-9);
}

TEST(Sewing, PanelsThatCloseOnABallStopThere) {
  // Rough and between both edges: no rate at which the gap closes can be kept.
  constexpr double kBall = 0.04, kApart = 0.1;
  CutSheet sheet = sewnSheet();
  const Garment g = sheet.garment(sheetFabric());
  Placement at;
  at.origin = {0.5 * sheet.length + 0.5 * kApart, 0.5 * sheet.width, 0};
  Motion m =
      startOf(g, {{0, 0, 0}, 1}, true, {1e-3, 1, 0.01, 1e-2, 400}, {{Ellipsoid{{kBall, kBall, kBall}}, "ball"}}, {at});
  for (int i = 0; i < m.model->freeCount(); ++i)
    if (m.model->cloth->map().home[i] >= g.patches[0].size()) m.state.p[i] += Vec3{kApart, 0, 0};
  m.restart();
  const double dt = 0.4 * stableStep(m);
  double fastest = 0, worst = 0;
  int zones = 0;
  for (int k = 0; k * dt < 0.12; ++k) {
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    zones += r.impact_zones;
    worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    for (const Vec3& v : m.state.v) fastest = std::max(fastest, norm(v));
  }
  std::vector<Vec3> rows;
  m.model->sewing.gaps(m.state.p, rows);
  double widest = 0;
  for (const Vec3& r : rows) widest = std::max(widest, norm(r));
  std::printf("with a ball between: at most %.2f m/s, %d zones, open by %.3f m\n", fastest, zones, widest);
  EXPECT_GT(widest, kBall);
  EXPECT_LT(widest, kApart);
  EXPECT_EQ(zones, 0);
  EXPECT_LT(fastest, 2);
  EXPECT_LT(worst, 1e-9);
}

TEST(Sewing, HoldsUnderContact) {
  // The seam falls onto a ball: both momenta of step and contact, and the gap.
  const CutSheet sheet = sewnSheet();
  const Garment g = sheet.garment(sheetFabric());
  Placement at;
  at.origin = {0.5 * sheet.length, 0.5 * sheet.width, -0.062};
  Motion m = startOf(g, {{0, 0, -9.81}, 0.1}, true, {1e-3, 0.3, 0.01, 1e-2, 400},
                     {{Ellipsoid{{0.06, 0.06, 0.06}}, "ball"}}, {at});
  double worst = 0, gap = 0, row = 0;
  int touching = 0;
  std::vector<Vec3> rows;
  const double dt = 0.4 * stableStep(m);
  for (int k = 0; k * dt < 0.15; ++k) {
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    ASSERT_TRUE(r.contact.converged);
    worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    gap = std::max(gap, widestGap(*m.model, m.state.p));
    m.model->sewing.gaps(m.state.p, rows);
    for (const Vec3& g_k : rows) row = std::max(row, norm(g_k));
    touching += contactsMeetSeams(*m.model, m.work.rows);
  }
  std::printf("on a ball: momentum %.1e, rows %.1e m, gap %.2e cells, %d steps with contacts on the seam\n", worst, row,
              gap, touching);
  EXPECT_GT(touching, 100);
  EXPECT_LT(worst, 1e-9);
  EXPECT_LT(row, 1e-9);
  EXPECT_LT(gap, 0.01);
}

TEST(Sewing, AHeavyPanelMakesContactsOfALightOneNoSlower) {
  // Where a contact touches the light side of a seam the heavy side is what it moves.
  const CutSheet sheet = sewnSheet();
  int most[2];
  for (const int unlike : {0, 1}) {
    Garment g = sheet.garment(sheetFabric());
    Fabric light = sheetFabric();
    light.density_kg_per_m3 *= unlike ? 0.01 : 1;
    g.other_fabrics = {light};
    g.fields.resize(2);
    g.fields[1].material = PatchField{0, 1, 1, {1}};
    Placement at;
    at.origin = {0.5 * sheet.length, 0.5 * sheet.width, -0.062};
    Motion m = startOf(g, {{0, 0, -9.81}, 0.1}, true, {1e-3, 0.3, 0.01, 1e-2, 4000},
                       {{Ellipsoid{{0.06, 0.06, 0.06}}, "ball"}}, {at});
    const double dt = 0.4 * stableStep(m);
    int touching = 0;
    most[unlike] = 0;
    for (int k = 0; k * dt < 0.03; ++k) {
      const StepReport r = m.step(dt);
      ASSERT_EQ(r.failure, StepFailure::none) << r.why;
      ASSERT_TRUE(r.contact.converged);
      most[unlike] = std::max(most[unlike], r.contact.iterations);
      touching += contactsMeetSeams(*m.model, m.work.rows);
    }
    std::printf("panels of %s masses: at most %d iterations, %d steps with contacts on the seam\n",
                unlike ? "unlike" : "like", most[unlike], touching);
    EXPECT_GT(touching, 20);
  }
  EXPECT_LT(most[0], 20);  // 25 and 189 where sweeps see their own side alone
  EXPECT_LT(most[1], 100);
}

/// What contacts see of the seams is what the seams do.
TEST(Sewing, TiesAreWhatTheProjectionTakes) {
  const CutSheet sheet = sewnSheet();
  const Garment g = sheet.garment(sheetFabric());
  const Motion m = startOf(g, {{0, 0, -9.81}, 0.1}, true);
  const Model& model = *m.model;
  const SparseRows all = model.sewing.ties(0), near = model.sewing.ties(1e-2);
  const std::vector<int>& points = model.sewing.points();
  SewnProjection::Work work;
  double worst = 0, left_out = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    std::vector<Vec3> change(static_cast<std::size_t>(model.freeCount()));
    const double own = model.inverse_mass[points[k]];
    if (own == 0) continue;
    change[points[k]] = {0, 0, own};
    model.sewing.hold(change, work);
    change[points[k]].z -= own;
    for (const SparseRows* H : {&all, &near}) {
      std::vector<Vec3> off = change;
      for (int e = H->offsets[k]; e < H->offsets[k + 1]; ++e) off[H->columns[e]].z += H->values[e];
      double& largest = H == &all ? worst : left_out;
      for (std::size_t i = 0; i < off.size(); ++i)
        if (model.inverse_mass[i] > 0)
          largest = std::max(largest, std::abs(off[i].z) / std::sqrt(own * model.inverse_mass[i]));
    }
  }
  std::printf("ties: off by %.1e, near ones by %.1e; %zu of %zu\n", worst, left_out, near.values.size(),
              all.values.size());
  EXPECT_LT(worst, 1e-12);
  EXPECT_LT(left_out, 1.001e-2);
  EXPECT_LT(near.values.size(), 0.7 * all.values.size());
}

/// One panel is moved whole, and takes the other along by their seam alone: all that it gives is work of the supports.
class PullsAPanel : public UniformStage {
 public:
  static constexpr double kPull = 4;  // m/s^2
  void heldMotions(double t, std::span<HeldMotion> motions) const override {
    const Vec3 way{0, 0, 0.5 * kPull * t * t};
    motions[0].pose = {rotationAbout({1, 0, 0}, 0), way};
    motions[0].rate = {way, {0, 0, kPull * t}, {}};
  }
};

TEST(Sewing, WhatAMovedPanelGivesIsInTheEnergy) {
  double off[2];
  for (const int fine : {0, 1}) {
    const Garment g = sewnSheet().garment(sheetFabric());
    ModelOptions o;
    o.self_contact = false;
    for (int k = 0; k < g.patches[1].size(); ++k) o.held_control_points.push_back(g.patches[0].size() + k);
    o.held_motion.assign(o.held_control_points.size(), 0);
    const auto model = buildModel(g, o, {{0, 0, -9.81}, 0.1}, {}, {}, {});
    PullsAPanel stage;
    StepWork work;
    State state = initialState(*model, stage, 0, work), next;
    for (int i = 0; i < model->freeCount(); ++i) {
      const int home = model->cloth->map().home[i];
      state.p[i] = home < g.patches[0].size() ? g.placed[0][static_cast<std::size_t>(home)]
                                              : g.placed[1][static_cast<std::size_t>(home - g.patches[0].size())];
    }
    attachSprings(*model, stage, state, work);
    const double dt = fine ? 5e-5 : 1e-4, first = energyOf(*model, stage, state, work).total();
    double works = 0, supports = 0, worst = 0;
    for (int k = 0; k * dt < 0.08; ++k) {
      const StepReport r = gambeson::step(*model, stage, state, dt, next, work);
      ASSERT_EQ(r.failure, StepFailure::none) << r.why;
      std::swap(state, next);
      works += r.work.drag + r.work.supports;
      supports += r.work.supports;
      worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    }
    off[fine] = std::abs(energyOf(*model, stage, state, work).total() - first - works) / std::abs(supports);
    std::printf("moved panel: supports %.4g J, energy off by %.3g of that, momentum %.1e\n", supports, off[fine],
                worst);
    EXPECT_LT(worst, 1e-9);
    EXPECT_GT(std::abs(supports), 1e-4);
  }
  EXPECT_LT(off[1], 2e-3);
  EXPECT_LT(off[1], 0.6 * off[0]);
}

/// A seam that is far open closes at its rates while one of its sides lies on a smooth ball: contact moves both sides alike.
/// Were they moved one by one, and brought together in the next step, seams would do work on what presses on itself.
TEST(Sewing, OpenSeamsCloseAtTheirRatesUnderContact) {
  const CutSheet sheet = sewnSheet();
  Garment apart = sheet.garment(sheetFabric());
  for (Vec3& x : apart.placed[1]) x.x += 0.1;
  Placement at;
  at.origin = {0.5 * sheet.length, 0.5 * sheet.width, -0.062};
  Motion m = startOf(apart, {{0, 0, -9.81}, 0.1}, true, {1e-3, 0, 0.01, 1e-2, 400},
                     {{Ellipsoid{{0.06, 0.06, 0.06}}, "ball"}}, {at});
  const double dt = 0.4 * stableStep(m);
  double off = 0, open = 1e300;
  int touching = 0;
  std::vector<Vec3> before, after;
  for (int k = 0; k * dt < 0.06; ++k) {
    m.model->sewing.gaps(m.state.p, before);
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    touching += !m.work.rows.empty() && contactsMeetSeams(*m.model, m.work.rows);
    m.model->sewing.gaps(m.state.p, after);
    double widest = 0;
    for (const Vec3& gap : before) widest = std::max(widest, norm(gap));
    open = std::min(open, widest);
    for (std::size_t row = 0; row < after.size(); ++row)
      off = std::max(off, norm(after[row] - (1 - dt * m.model->sewing_options.close_m_per_s / widest) * before[row]));
  }
  std::printf("open seam under contact: off its rates by %.1e m, %d steps with contacts on it\n", off, touching);
  EXPECT_GT(touching, 50);
  EXPECT_GT(open, 0.08);
  EXPECT_LT(off, 1e-9);
}

/// Of two garments one falls onto a ball and the seam of the other is still far open: the first one's holds.
TEST(Sewing, OneGarmentsSeamsHoldWhileAnothersAreOpen) {
  const CutSheet sheet = sewnSheet();
  Garment apart = sheet.garment(sheetFabric());
  const Vec3 aside{0, 1, 0};
  for (NurbsPatch& p : apart.patches)
    for (Vec3& x : p.points) x += aside;
  for (auto& points : apart.placed)
    for (Vec3& x : points) x += aside;
  for (Vec3& x : apart.placed[1]) x.x += 0.1;
  const std::vector<Garment> both{sheet.garment(sheetFabric()), apart};
  Placement at;
  at.origin = {0.5 * sheet.length, 0.5 * sheet.width, -0.062};
  Motion m = startOf(joinGarments(both), {{0, 0, -9.81}, 0.1}, true, {1e-3, 0.3, 0.01, 1e-2, 400},
                     {{Ellipsoid{{0.06, 0.06, 0.06}}, "ball"}}, {at});
  const double dt = 0.4 * stableStep(m);
  double held = 0, open = 1e300, worst = 0;
  int touching = 0;
  std::vector<Vec3> rows;
  for (int k = 0; k * dt < 0.06; ++k) {
    const StepReport r = m.step(dt);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    touching += !m.work.rows.empty() && contactsMeetSeams(*m.model, m.work.rows);
    m.model->sewing.gaps(m.state.p, rows);
    double widest[2] = {0, 0};
    for (std::size_t k_row = 0; k_row < rows.size(); ++k_row) {
      double& its = widest[m.model->sewn_garment[k_row]];
      its = std::max(its, norm(rows[k_row]));
    }
    held = std::max(held, widest[0]);
    open = std::min(open, widest[1]);
  }
  std::printf("two garments: seam that holds %.1e m, that is open %.3f m, %d steps with contacts on the seam\n", held,
              open, touching);
  EXPECT_GT(touching, 50);
  EXPECT_GT(open, 0.08);
  EXPECT_LT(held, 1e-9);
  EXPECT_LT(worst, 1e-9);
}

}  // namespace
}  // namespace gambeson
