/// Momentum of every step of every library case, in short pieces on coarser sheets: change = gravity + drag + supports
/// - obstacles within 1e-9 of the sum of the absolute impulses.

#include <gtest/gtest.h>

#include <cstdio>

#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

void expectBalanced(const Case& c, double end_s) {
  SceneRun scene(c);
  AuditWatch audit;
  double supports = 0;
  scene.run(end_s, [&](const State&, const State&, const StepReport& r, const StepResult& w, const Frequency&) {
    audit(r);
    supports = std::max(supports, norm(r.momentum.supports));
    Vec3 ledger{};
    for (const ContactImpulse& i : w.contact_impulses) ledger -= i.impulse;
    EXPECT_LE(norm(ledger - r.momentum.obstacles), 1e-12 * r.momentum.scale);
  });
  std::printf("[ measured ] %s: %.2g over %d steps, %d with contact\n", c.name.c_str(), audit.worst, audit.steps,
              audit.with_contact);
  EXPECT_LT(audit.worst, 1e-9);
  EXPECT_GT(audit.with_contact, 10);
  EXPECT_EQ(supports > 0, !c.supports.empty());
}

TEST(MomentumAudit, InclinedPlane) { expectBalanced(libraryCase("inclined_plane"), 0.3); }

TEST(MomentumAudit, SphereDrape) {
  expectBalanced(libraryCase("sphere_drape", {"garment.sheet.cells_u=12", "garment.sheet.cells_v=12"}), 0.3);
}

TEST(MomentumAudit, SleeveFlex) {
  expectBalanced(libraryCase("sleeve_flex",
                             {"garment.tube.cells_around=12", "garment.tube.cells_along=12", "dressing.settle=0.15 s"}),
                 0.1);
}

TEST(MomentumAudit, ShortsWalk) {
  expectBalanced(libraryCase("shorts_walk",
                             {"garment.shorts.cell=40 mm", "dressing.projecting.grow=0.1 s", "dressing.settle=0.05 s"}),
                 0.05);
}

}  // namespace
}  // namespace gambeson
