/// The skirt of Zheng 2013, 5.6.3: counts of table 5.3, and that the hips carry it.

#include <gtest/gtest.h>

#include <cmath>

#include "unit/cases/wear/scene/scene.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

TEST(SkirtDrape, HasTheSizesOfTheThesis) {
  const auto s = buildScenario(libraryCase("skirt_drape"));
  EXPECT_EQ(s->model->cloth->points(), 960);
  EXPECT_EQ(shellOf(*s->model).garment().patches.size(), 8u);
  EXPECT_NEAR(static_cast<double>(s->human->skin->rest.triangles.size()) / 17068, 1, 0.03);
  const Fabric& f = s->definition.fabric;
  // rho = 0.118 kg/m^2, k / rho = 3000 m^2/s^2, k = 2.5 k_shear; the cases (a) and (c) of its description: 50.
  const double rho = s->model->density_kg_per_m2[0];
  EXPECT_NEAR(rho, 0.118, 1e-4);
  EXPECT_NEAR(f.young_weft_Pa * f.thickness() / rho, 3000, 3);
  EXPECT_NEAR(f.young_warp_Pa / f.shear_Pa, 2.5, 1e-4);
  EXPECT_NEAR(5012.7 * f.thickness() / rho, 50, 0.05);
}

/// Coarser and dressed faster than in the library: the hips carry the weight, and nothing passes.
TEST(SkirtDrape, TheHipsCarryIt) {
  SceneRun scene(libraryCase(
      "skirt_drape",
      {"garment.skirt.cells_around=32", "garment.skirt.cells_along=6", "human.skin.cell=0.02", "dressing.settle=0",
       "dressing.projecting={\"clearance\": \"5 mm\", \"grow\": \"0.1 s\"}", "time.duration=0.3"}));
  AuditWatch audit;
  double carried = 0, from_s = 0.2, deepest = 0;
  scene.run(
      0.3, [&](const State& before, const State& after, const StepReport& r, const StepResult& work, const Frequency&) {
        audit(r);
        deepest = std::max(deepest, r.deepest_m);
        if (before.time_s < from_s) return;
        for (const ContactImpulse& c : work.contact_impulses) carried += c.impulse.z;
        EXPECT_EQ(after.tangled, false);
      });
  EXPECT_LT(audit.worst, 1e-9);
  EXPECT_LT(deepest, 0.2e-3);
  double mass = 0;
  for (const double m : scene.model.mass_kg) mass += m;
  EXPECT_NEAR(carried / (0.1 * 9.81 * mass), 1, 0.15);
}

}  // namespace
}  // namespace gambeson
