/// What a thickness map is worth, of runs whose torques are given.

#include <gtest/gtest.h>

#include "cases/study/optimise.hpp"

namespace gambeson::study {
namespace {

MapRun at(double torque_Nm, double mass_kg = 1) { return {"map", {1, 1}, torque_Nm, "left hip", mass_kg, 0, ""}; }

/// 8 Nm become 6: a gain of 0.25; a repeat says 0.2, the finer mesh 0.28.
Optimise searched() {
  Optimise o;
  o.found.runs = {at(8), at(9), at(6.2), at(6), at(7)};
  o.found.best = 3;
  o.found.repeats = {{"other steps", at(8), at(6.4)}};
  o.found.finer = MapPair{"a finer mesh", at(5), at(3.6)};
  return o;
}

TEST(MapGain, TheBarIsHowFarTheGainMoves) {
  const MapGain g = gainOf(searched());
  EXPECT_DOUBLE_EQ(g.gain, 0.25);
  EXPECT_NEAR(g.noise, 0.05, 1e-12);
  EXPECT_NEAR(*g.mesh, 0.03, 1e-12);
  EXPECT_NEAR(*g.finer, 0.28, 1e-12);
  EXPECT_NEAR(g.bar(), 0.08, 1e-12);
  EXPECT_TRUE(g.sure);
  // The third map has all of the gain but 0.2 Nm, which is less than repeats scatter (0.05 of 8 Nm).
  EXPECT_EQ(g.helps_until, 2u);
}

TEST(MapGain, AGainWithinItsBarIsNotSure) {
  Optimise o = searched();
  o.found.repeats[0].best = at(8.1);  // there the map costs more
  EXPECT_FALSE(gainOf(o).sure);
  o = searched();
  o.found.finer->best = at(5.1);
  EXPECT_FALSE(gainOf(o).sure);
  o = searched();
  o.found.repeats[0] = {"the same steps", at(8), at(6)};  // the same to the last digit: nothing is known of chance
  EXPECT_FALSE(gainOf(o).sure);
  o = searched();
  o.found.best = 0;
  EXPECT_FALSE(gainOf(o).sure);
}

TEST(MapGain, ALightMapIsSureBelowItsLimitWithTheBar) {
  Optimise o;
  o.aim = Aim::mass;
  o.limit_Nm = 4;
  o.found.runs = {at(3, 2), at(3.9, 1.5)};
  o.found.best = 1;
  o.found.repeats = {{"other steps", at(3, 2), at(3.939, 1.5)}};  // 1 % more
  MapGain g = gainOf(o);
  EXPECT_DOUBLE_EQ(g.gain, 0.25);
  EXPECT_NEAR(g.bar(), 0.01, 1e-12);
  EXPECT_TRUE(g.sure);
  o.found.repeats[0].best = at(4.095, 1.5);  // 5 %
  EXPECT_FALSE(gainOf(o).sure);
}

}  // namespace
}  // namespace gambeson::study
