/// Panels that their pattern places too low: as high as their shoulder seams close over the shoulders.
#include "tryon/pattern/flat/lift_panels.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "human/manikin/manikin.hpp"
#include "human/motion/standing.hpp"
#include "unit/tryon/pattern/flat/region_patterns.hpp"

namespace gambeson {
namespace {

using namespace region_patterns;

/// Front and back of a shirt in planes 25 cm before and behind the middle, their necks at a height.
FlatPattern tunic(const StandingBody& form, double neck_z) {
  FlatPattern p = shirt({});
  p.panels.resize(2);
  std::erase_if(p.seams, [](const PanelSeam& s) { return s.name.find("side") + s.name.find("shoulder") > 1000; });
  const double middle = form.origin(form.links({"torso"})[0]).x;
  for (int k : {0, 1}) {
    const double to = k == 0 ? 1 : -1;
    p.panels[k].placement = PanelPlace{{middle + 0.25 * to, form.medianY(), neck_z - 0.66}, {0, to, 0}, {0, 0, 1}};
  }
  checkPattern(p);
  return p;
}

TEST(LiftPanels, ShoulderSeamsStartAboveTheShoulders) {
  const Human human = makeManikin("male_p50");
  const StandingBody form(human, withArmsAside(human, standing(human), 0.7));
  const double shoulder = form.origin(form.links({"upper_arm_left"})[0]).z;
  const auto lifted = [&](double above) { return liftOverBody(tunic(form, shoulder + above), {}, form); };
  const PanelLift high = lifted(0.25);
  EXPECT_TRUE(high.panel_m.empty());
  EXPECT_EQ(high.through_m, 0);
  double last = 0;
  for (const double above : {0.04, 0.0, -0.04}) {
    const PanelLift lift = lifted(above);
    ASSERT_EQ(lift.panel_m.size(), 2u);
    std::printf("neck %+.2f m over the shoulder: lifted by %.2f m, %.2f m of seam through the body, then %.2f m\n",
                above, lift.panel_m[0], lift.through_m, lift.left_m);
    EXPECT_GT(lift.through_m, 0.1);
    EXPECT_LT(lift.left_m, lift.through_m - 0.03);  // near the neck a line still passes through it
    EXPECT_GT(lift.panel_m[0], 0.03);
    EXPECT_NEAR(lift.panel_m[0], lift.panel_m[1], 1e-6);
    if (last > 0) EXPECT_NEAR(lift.panel_m[0], last + 0.04, 0.021);
    last = lift.panel_m[0];
  }
}

/// Where the garment is put counts, and a panel that stands lower than its seams have it comes up to the other.
TEST(LiftPanels, BringsSeamsToOneHeight) {
  const Human human = makeManikin("male_p50");
  const StandingBody form(human, withArmsAside(human, standing(human), 0.7));
  const double shoulder = form.origin(form.links({"upper_arm_left"})[0]).z;
  const PanelLift here = liftOverBody(tunic(form, shoulder), {}, form);
  FlatPattern lower = tunic(form, shoulder - 0.1);
  lower.panels[1].placement->origin_m.z -= 0.06;
  const PanelLift put = liftOverBody(lower, {0, 0, 0.1}, form);
  ASSERT_EQ(put.panel_m.size(), 2u);
  EXPECT_NEAR(put.panel_m[1] - put.panel_m[0], 0.06, 1e-6);
  EXPECT_NEAR(put.panel_m[0], here.panel_m[0], 0.021);
}

}  // namespace
}  // namespace gambeson
