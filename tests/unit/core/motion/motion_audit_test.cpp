#include "core/motion/motion_audit.hpp"

#include <gtest/gtest.h>

#include "core/cloth/shell/shell_supports.hpp"
#include "unit/core/motion/motion_shapes.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const std::vector<Vec3> kAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

struct Gaps {
  double energy = 0, momentum = 0;  ///< over the works and the impulses
};

/// Half a metre of cloth, one edge held and shaken upwards, the other free, falling in air for 0.1 s.
Gaps gapsOf(DynamicOptions o, bool lumped, double audit_weight = 1, double audit_drag = 0.3) {
  const Garment g = squareSheet(8, 0.5, 0);
  StructureOptions so;
  so.constraints = supportEdge(g, {0, Side::u0}, kAxes, {{0, 0, 0.02}, 1});
  so.dead.push_back({weightForce(g, {0, 1, -9.8}), 0});
  so.programs = {{{0}, {1}}, {{0, 1}, {0, 10}}};
  so.drag_kg_per_m2s = 0.3;
  so.rayleigh_mass_per_s = 0.5;
  const auto s = buildStructure(g, so);
  StructureOptions seen = so;
  for (Vec3& f : seen.dead[0].force_N) f *= audit_weight;
  seen.drag_kg_per_m2s = audit_drag;
  const auto audited = buildStructure(g, seen);
  DynamicState state;
  state.y.assign(static_cast<std::size_t>(s->dofs.unknowns()), 0.0);
  state.v = state.a = state.y;
  o.end_s = 0.1;
  MotionAudit audit(*audited, lumped);
  const DynamicReport r = solveDynamic(*s, o, state, [&](const DynamicState& now) {
    audit.observe(now);
    return true;
  });
  EXPECT_TRUE(r.reached) << r.why;
  EXPECT_GT(audit.works(), 0);
  return {audit.largestEnergyGap() / audit.works(), audit.largestMomentumGap() / audit.impulses()};
}

/// Velocity Verlet keeps the momentum's balance to rounding; the energy's gap falls fourfold with half the step.
TEST(MotionAudit, ExplicitSteps) {
  const DynamicOptions o{.scheme = TimeScheme::explicit_verlet, .step_s = 1e-4};
  DynamicOptions half = o;
  half.step_s = 0.5e-4;
  const Gaps a = gapsOf(o, true), b = gapsOf(half, true);
  EXPECT_LT(a.momentum, 1e-9);
  EXPECT_LT(b.energy, 1e-3);
  EXPECT_GT(a.energy / b.energy, 3);
}

/// The trapezoidal rule too, with the consistent mass.
TEST(MotionAudit, NewmarkSteps) {
  const DynamicOptions o{.scheme = TimeScheme::newmark, .step_s = 1e-3, .tolerance = 1e-11};
  const Gaps a = gapsOf(o, false);
  EXPECT_LT(a.momentum, 1e-7);
  EXPECT_LT(a.energy, 1e-2);
}

/// A hundredth more weight, or drag, than the motion has opens both gaps.
TEST(MotionAudit, SeesALostForce) {
  const DynamicOptions o{.scheme = TimeScheme::explicit_verlet, .step_s = 1e-4};
  const Gaps weight = gapsOf(o, true, 1.01), drag = gapsOf(o, true, 1, 0.303);
  EXPECT_GT(weight.momentum, 1e-3);
  EXPECT_GT(weight.energy, 1e-4);
  EXPECT_GT(drag.momentum, 1e-5);
  EXPECT_GT(drag.energy, 1e-5);
}

}  // namespace
}  // namespace gambeson
