// Legs of shorts and trousers: down to the ankle on every manikin, around all of the leg, on their own sides.
#include "tryon/pattern/leg_form.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "tryon/pattern/check.hpp"
#include "tryon/pattern/pattern.hpp"
#include "unit/manikins_asked.hpp"

namespace gambeson {
namespace {

class Legs : public testing::TestWithParam<const char*> {
 protected:
  Human human = makeManikin(GetParam());
  BodyForm form{human};
  ShortsPattern pattern;

  double crotch() const { return form.lowest({0}) - pattern.crotch_ease_m; }
  double ankle() const { return form.origin(form.links({"foot_left"}, "ankle")[0]).z; }
  /// Trousers whose hem stands so far above the ankle.
  Garment trousers(double above_m) {
    pattern.inseam_m = crotch() - ankle() - above_m;
    pattern.cell_m = 0.035;
    return makeShorts(pattern, form);
  }
};

TEST_P(Legs, AreTheThighAloneAboveTheKnee) {
  const Links thigh = form.links({"thigh_left"}, "thigh");
  const double hem = form.lowest(thigh) + 1e-3;
  const LegForm leg(form, crotch(), hem);
  for (int k = 0; k <= 10; ++k) {
    const double z = hem + (crotch() - hem) * k / 10;
    EXPECT_EQ(leg.at(z).length(), ClosedCurve(form.hull(z, thigh, false, "z")).length());
  }
}

TEST_P(Legs, ReachTheAnkleAroundAllOfTheLeg) {
  const Garment g = trousers(1e-3);
  EXPECT_NO_THROW(validate(g));
  const Links leg = form.links({"thigh_left", "shank_left", "foot_left"}, "leg");
  double least_y = HUGE_VAL, tightest = HUGE_VAL;
  for (int k = 0; k <= 40; ++k) {
    const double v = k / 40.0, z = surfaceDerivatives(g.patches[outer_left], 0.5, v)[0].z;
    std::vector<Vec2> tape;
    for (const int n : {outer_left, inner_left})
      for (int i = 0; i <= 200; ++i) {
        const Vec3 x = surfaceDerivatives(g.patches[n], i / 200.0, v)[0];
        EXPECT_NEAR(x.z, z, 1e-9);
        tape.push_back({x.x, x.y});
        if (v < 1) least_y = std::min(least_y, x.y);
      }
    if (v == 0) {
      EXPECT_NEAR(z, ankle() + 1e-3, 1e-9);
    }
    // Outside of the leg in every direction, save where the other leg is.
    const ClosedCurve cloth(convexHull(tape));
    for (const Vec2& p : form.level(z, leg))
      if (p.y > form.medianY() + 0.02 && (1 - v) * pattern.inseam_m > pattern.blend_m) {
        const Vec2 c = cloth.centroid(), ray{p.x - c.x, p.y - c.y};
        const Vec2 out = cloth.point(cloth.crossing(c, ray));
        tightest = std::min(tightest, std::hypot(out.x - c.x, out.y - c.y) - std::hypot(ray.x, ray.y));
      }
  }
  EXPECT_GT(least_y, form.medianY());
  EXPECT_GT(tightest, 0);
}

// A cut across the shank is cos(lean) as long as a level one in the direction of the lean.
TEST_P(Legs, StandNearlyUpright) {
  const Vec2 lean = LegForm(form, crotch(), ankle() + 1e-3).lean();
  EXPECT_LT(1 - 1 / std::sqrt(1 + lean.x * lean.x + lean.y * lean.y), 4e-3) << lean.x << " " << lean.y;
}

// Wide enough for what lies above the hem, and no narrower anywhere than straight lines from hem to crotch.
TEST_P(Legs, TaperToAHemAsWideAsTheCalf) {
  const Garment g = trousers(0.02);
  const auto girth = [&](double v) {
    std::vector<Vec2> tape;
    for (const int n : {outer_left, inner_left})
      for (int i = 0; i <= 200; ++i) {
        const Vec3 x = surfaceDerivatives(g.patches[n], i / 200.0, v)[0];
        tape.push_back({x.x, x.y});
      }
    return ClosedCurve(convexHull(tape)).length();
  };
  const double hem = girth(0), top = 1 - (pattern.blend_m + pattern.cell_m) / pattern.inseam_m, thigh = girth(top);
  for (int k = 0; k <= 10; ++k) EXPECT_GT(girth(top * k / 10), hem + (thigh - hem) * k / 10 - 0.003 * hem) << k;
  const Links leg = form.links({"thigh_left", "shank_left", "foot_left"}, "leg");
  const double knee = form.origin(leg[1]).z;
  for (int k = 0; k <= 20; ++k) {
    const double body =
        ClosedCurve(form.hull(ankle() + 0.02 + (knee - ankle() - 0.02) * k / 20, leg, false, "z")).length();
    EXPECT_GT(hem, (1 + pattern.ease) * body * 0.995) << k;
  }
  EXPECT_LT(hem, 0.9 * thigh);
}

TEST_P(Legs, EndAtTheAnkle) {
  try {
    trousers(-1e-3);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "inseam_m");
  }
}

INSTANTIATE_TEST_SUITE_P(Manikins, Legs, testing::ValuesIn(manikinsAsked<const char*>()));

}  // namespace
}  // namespace gambeson
