/// The momentum audit of a step that has every term in it: it holds to rounding, and fails when a term is wrong.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// A sheet held along an edge, hung on springs at two corners, in the wind, over a rising ball that it touches.
Motion everything() {
  const Garment g = squareSheet(8, 0.2, 0);
  ModelOptions o;
  for (int j = 0; j < g.patches[0].v.count(); ++j) o.held_control_points.push_back(g.patches[0].index(0, j));
  o.anchor_count = 1;
  o.springs = {{16, 0, 0.5}, {288, 0, 0.5}};
  Motion m(g, {{0, 0, -9.81}, 0.5}, {1e-3, 0.3, 0.01, 1e-2, 400}, o, {{Ellipsoid{{0.05, 0.05, 0.05}}, "ball"}},
           {{{}, {0.1, 0.1, -0.06}, 1}}, {{0, 0.1, 0.3}});
  m.stage.wind = {0.5, 1, 0};
  m.restart();
  return m;
}

TEST(Momentum, EveryStepBalances) {
  Motion m = everything();
  double worst = 0;
  int contacts = 0;
  for (int s = 0; s < 400; ++s) {
    const StepReport r = m.step(3e-4);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    contacts += !m.work.contact_impulses.empty();
  }
  EXPECT_LT(worst, 1e-12);
  EXPECT_GT(contacts, 100);
}

TEST(Momentum, AWrongTermShows) {
  Motion m = everything();
  StepReport r;
  for (int s = 0; s < 800 && (s < 400 || m.work.contact_impulses.size() < 2); ++s) r = m.step(3e-4);
  const MomentumAudit& good = r.momentum;
  ASSERT_LT(good.error(), 1e-12 * good.scale);
  ASSERT_GT(m.work.contact_impulses.size(), 1u);
  const auto error = [&](const std::function<void(MomentumAudit&)>& spoil) {
    MomentumAudit bad = good;
    spoil(bad);
    return bad.error() / bad.scale;
  };
  for (Vec3 MomentumAudit::*term : {&MomentumAudit::change, &MomentumAudit::gravity, &MomentumAudit::drag,
                                    &MomentumAudit::supports, &MomentumAudit::obstacles}) {
    EXPECT_GT(norm(good.*term), 1e-3 * good.scale);
    EXPECT_GT(error([&](MomentumAudit& a) { (a.*term) *= 1 + 1e-6; }), 1e-9);
    EXPECT_GT(error([&](MomentumAudit& a) { (a.*term) = {}; }), 1e-3);
  }
  int spoiled = 0;
  for (const ContactImpulse& i : m.work.contact_impulses) {
    if (norm(i.impulse) < 1e-8 * good.scale) continue;
    ++spoiled;
    EXPECT_GT(error([&](MomentumAudit& a) { a.obstacles += i.impulse; }), 1e-9);
  }
  EXPECT_GT(spoiled, 0);
  ASSERT_EQ(m.work.spring_impulses.size(), 2u);
  for (const Vec3& i : m.work.spring_impulses) {
    EXPECT_GT(norm(i), 1e-6 * good.scale);
    EXPECT_GT(error([&](MomentumAudit& a) { a.supports -= i; }), 1e-9);
  }
}

/// Not in the sums but in the motion: what moves the cloth is not what the audit believes.
TEST(Momentum, AWrongMotionShows) {
  const std::vector<std::pair<const char*, std::function<void(Motion&)>>> spoils{
      {"gravity", [](Motion& m) { m.model->environment.gravity_m_per_s2 *= 1 + 1e-6; }},
      {"a mass", [](Motion& m) { m.model->mass_kg[44] *= 1 + 1e-4; }},
      {"an inverse mass",
       [](Motion& m) {
         for (double& w : m.model->inverse_mass) w *= 1 + 1e-6;
       }},
      {"an acceleration", [](Motion& m) { m.state.a[44] *= 1 + 1e-4; }},
      {"the drag's sum", [](Motion& m) { m.state.sums.drag *= 1 + 1e-5; }},
      {"the held points' sum", [](Motion& m) { m.state.sums.held *= 1 + 1e-5; }},
      {"the springs' sum", [](Motion& m) { m.state.sums.springs *= 1 + 1e-5; }},
  };
  for (const auto& [name, spoil] : spoils) {
    Motion m = everything();
    for (int s = 0; s < 400; ++s) m.step(3e-4);
    spoil(m);
    const StepReport r = m.step(3e-4);
    EXPECT_GT(r.momentum.error(), 1e-9 * r.momentum.scale) << name;
  }
}

/// A free sheet that swings in air that hardly resists: nothing but rounding and a drag of the same size acts.
TEST(Momentum, BalancesWhereOnlyAFaintDragActs) {
  Motion m = vibration();
  m.model = buildModel(squareSheet(6, 0.2, 0), {}, {{0, 0, 0}, 1e-12}, {}, {});
  Vec3 p{};
  double mass = 0;
  for (int i = 0; i < m.model->freeCount(); ++i) p += m.model->mass_kg[i] * m.state.v[i], mass += m.model->mass_kg[i];
  for (Vec3& v : m.state.v) v -= p / mass;
  m.restart();
  double worst = 0, absolute = 0;
  StepReport r;
  for (int s = 0; s < 400; ++s) {
    r = m.step(3e-4);
    worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    absolute = std::max(absolute, r.momentum.error() / norm(r.momentum.drag));
  }
  EXPECT_GT(absolute, 1e-9);  // of what acts, rounding is more than the limit
  EXPECT_LT(worst, 1e-9);
  // An impulse that is not booked still shows.
  r.momentum.supports += Vec3{1e-10 * mass * 0.5, 0, 0};
  EXPECT_GT(r.momentum.error() / r.momentum.scale, 1e-9);
}

/// At rest the supports carry the weight.
TEST(Momentum, SupportsOfAHangingSheetCarryItsWeight) {
  const Garment g = squareSheet(6, 0.2, 0);
  ModelOptions o;
  for (int j = 0; j < g.patches[0].v.count(); ++j) o.held_control_points.push_back(g.patches[0].index(0, j));
  Motion m(g, {{9.81, 0, 0}, 5}, {}, o);
  StepReport r;
  for (int s = 0; s < 6000; ++s) r = m.step(3e-4);
  double weight = 0;
  for (int i = 0; i < m.model->freeCount(); ++i) weight += m.model->held[i] ? 0 : 9.81 * m.model->mass_kg[i];
  EXPECT_NEAR(r.momentum.supports.x, -weight * 3e-4, 1e-4 * weight * 3e-4);
  EXPECT_LT(norm(r.momentum.change), 1e-4 * weight * 3e-4);
}

}  // namespace
}  // namespace gambeson
