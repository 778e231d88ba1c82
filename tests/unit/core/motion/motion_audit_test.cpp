#include "core/motion/motion_audit.hpp"

#include <gtest/gtest.h>

#include "core/cloth/patches/patch_supports.hpp"
#include "unit/core/motion/motion_shapes.hpp"
#include "unit/core/motion/structure_moves.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const std::vector<Vec3> kAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

struct Gaps {
  double energy = 0, momentum = 0;  ///< over the works and the impulses
};

/// Half a metre of cloth, one edge held and shaken upwards, the other free, falling in air for 0.1 s.
/// `step_s`: of explicit steps, or of the trapezoidal rule.
Gaps gapsOf(bool is_explicit, double step_s, double audit_weight = 1, double audit_drag = 0.3) {
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
  constexpr double end_s = 0.1;
  MotionAudit audit(*audited, is_explicit);
  if (is_explicit) {
    ExplicitSteps(*s).run(end_s, step_s, [&](const State& before, const State& now, const StepReport& r) {
      audit.observe(before, now, r);
    });
  } else {
    State state = structureState(*s, 0, std::vector<double>(static_cast<std::size_t>(s->dofs.unknowns()), 0.0), {}, {});
    const Watch watch = [&](const State&, const State& now, const StepReport& r) { audit.observe(now, r.work.cloth); };
    ImplicitSteps(*s, {.scheme = ImplicitScheme::newmark, .step_s = step_s, .tolerance = 1e-11})
        .advance(end_s, state, observerOf(watch));
  }
  EXPECT_GT(audit.works(), 0);
  return {audit.largestEnergyGap() / audit.works(), audit.largestMomentumGap() / audit.impulses()};
}

/// Velocity Verlet keeps the momentum's balance to rounding; the energy's gap falls fourfold with half the step.
TEST(MotionAudit, ExplicitSteps) {
  const Gaps a = gapsOf(true, 1e-4), b = gapsOf(true, 0.5e-4);
  EXPECT_LT(a.momentum, 1e-9);
  EXPECT_LT(b.energy, 1e-3);
  EXPECT_GT(a.energy / b.energy, 3);
}

/// The trapezoidal rule too, with the consistent mass.
TEST(MotionAudit, NewmarkSteps) {
  const Gaps a = gapsOf(false, 1e-3);
  EXPECT_LT(a.momentum, 1e-7);
  EXPECT_LT(a.energy, 1e-2);
}

/// A hundredth more weight, or drag, than the motion has opens both gaps.
TEST(MotionAudit, SeesALostForce) {
  const Gaps weight = gapsOf(false, 1e-3, 1.01), drag = gapsOf(false, 1e-3, 1, 0.303);
  EXPECT_GT(weight.momentum, 1e-3);
  EXPECT_GT(weight.energy, 1e-4);
  EXPECT_GT(drag.momentum, 1e-5);
  EXPECT_GT(drag.energy, 1e-5);
}

}  // namespace
}  // namespace gambeson
