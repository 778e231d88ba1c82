/// Cuts in a sheet: which control points both sides share.
#include "core/cloth/draft/shared_points.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/cloth/draft/seams.hpp"
#include "unit/core/cloth/sewn_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// A square of 8 cells, cut in two along x = 0 from top to bottom; `other` cells along the cut in the second patch.
Garment cutInTwo(int other) {
  Garment g = garmentOf({panelPatch(8, 8, {-0.4, -0.4}, {0.4, 0.4}), panelPatch(8, other, {-0.4, -0.4}, {0.4, 0.4})},
                        {}, plainFabric());
  g.trims.resize(2);
  g.trims[0].loops = {polygon(std::vector<Vec2>{{-0.4, -0.4}, {0, -0.4}, {0, 0.4}, {-0.4, 0.4}})};
  g.trims[1].loops = {polygon(std::vector<Vec2>{{0, -0.4}, {0.4, -0.4}, {0.4, 0.4}, {0, 0.4}})};
  const NurbsCurve cut = line({0, -0.4}, {0, 0.4});
  g.sewn_seams = {{{{0, cut, 0, 1}}, {{1, cut, 0, 1}}}};
  return g;
}

int sharedIn(const Garment& g) {
  const std::vector<int> owners = sharedOwners(g);
  int shared = 0;
  for (std::size_t i = 0; i < owners.size(); ++i) shared += owners[i] != static_cast<int>(i);
  return shared;
}

TEST(SharedPoints, AreThoseThatReachAcrossACut) {
  // Along x the four functions of which two reach across the knot line, along y all ten.
  EXPECT_EQ(sharedIn(cutInTwo(8)), 2 * 10);
  EXPECT_EQ(sharedIn(cutInTwo(9)), 0);  // other knots: a seam
  Garment g = cutInTwo(8);
  g.sewn_seams[0].hold = SeamHold::open;
  EXPECT_EQ(sharedIn(g), 0);
  g = cutInTwo(8);
  for (Vec3& x : g.patches[1].points) x.z += 0.1;  // it lies elsewhere
  EXPECT_EQ(sharedIn(g), 0);
}

TEST(SharedPoints, MakeOneSheetOfBothPatches) {
  const Garment g = cutInTwo(8);
  EXPECT_TRUE(buildSewnRows(g, SeamHold::projected).empty());  // nothing is left to hold
  const FreeMap map = buildFreeMap(g);
  EXPECT_EQ(map.home.size(), 100u);  // as many as the sheet has in one piece
}

/// A slit from the left to the middle, whose sides are sewn and meet there.
TEST(SharedPoints, StayApartWhereASlitEnds) {
  Garment g = cutInTwo(8);
  const auto lines = [](const std::vector<Vec2>& corners) { return polygon(corners); };
  g.trims[0].loops = {lines({{-0.4, 0.05}, {0, 0}, {0.4, 0}, {0.4, 0.4}, {-0.4, 0.4}})};
  g.trims[1].loops = {lines({{-0.4, -0.05}, {-0.4, -0.4}, {0.4, -0.4}, {0.4, 0}, {0, 0}})};
  const NurbsCurve cut = line({0, 0}, {0.4, 0}), upper = line({0, 0}, {-0.4, 0.05}),
                   lower = line({0, 0}, {-0.4, -0.05});
  g.sewn_seams = {{{{0, upper, 0, 1}}, {{1, lower, 0, 1}}}, {{{0, cut, 0, 1}}, {{1, cut, 0, 1}}}};
  // Along x eight functions reach the cut (x > 0), of which two reach the slit (x < 0); along y two.
  EXPECT_EQ(sharedIn(g), (6 - 2) * 2);
}

}  // namespace
}  // namespace gambeson
