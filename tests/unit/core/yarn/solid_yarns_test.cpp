/// Meshes of yarns: their volume, their fibres, where they touch.

#include "core/yarn/solid_yarns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "core/error.hpp"
#include "core/solid/solid_body.hpp"

namespace gambeson {
namespace {

/// Man 2006, section 4.3.5.2 [Pa].
constexpr BonetBurton kYarn{0.4457e9, 0.5154e9, 0.2714e9, 0.06548e9, 10.54e9};

/// Spacing 1, A = b = 0.160, a = 1.5 b (issue 21, A12).
WovenYarns woven(const Weave& weave = plainWeave()) {
  const WovenYarn y{1, 0.16, 0.24, 0.16};
  return {weave, {y, y}};
}

double volumeOf(const SolidYarns& s) { return SolidBody(s.mesh).volume(); }

TEST(SolidYarns, HaveTheVolumeOfYarnsOnEveryMesh) {
  for (const YarnMeshing& m : {YarnMeshing{2, 5}, {2, 13}, {3, 9}, {4, 5}, {4, 13}, {7, 7}}) {
    const SolidYarns quarter = solidYarns(woven(), {kYarn, kYarn}, m, true);
    EXPECT_NEAR(volumeOf(quarter) / (4 * 0.16), 0.400, 0.001) << m.across << " " << m.along;
    const double exact = 2 * std::numbers::pi * 0.24 * 0.16 * woven().arcLength_m(along_weft, 0, 0, 1);
    EXPECT_NEAR(volumeOf(quarter), exact, 1e-12 * exact);
  }
  const SolidYarns full = solidYarns(woven(), {kYarn, kYarn}, {3, 7}, false);
  EXPECT_EQ(full.bodies.size(), 4u);
  EXPECT_NEAR(volumeOf(full) / (4 * 4 * 0.16), 0.400, 0.001);
  const SolidYarns twill = solidYarns(woven(twillWeave(2, 2)), {kYarn, kYarn}, {2, 5}, false);
  double exact = 0;
  for (const YarnBody& b : twill.bodies) exact += std::numbers::pi * 0.24 * 0.16 * b.length_m;
  EXPECT_EQ(twill.bodies.size(), 8u);
  EXPECT_NEAR(volumeOf(twill), exact, 1e-12 * exact);
}

TEST(SolidYarns, FibresFollowTheMiddleOfTheYarn) {
  const WovenYarns yarns = woven();
  const SolidYarns s = solidYarns(yarns, {kYarn, kYarn}, {2, 5}, false);
  ASSERT_EQ(s.mesh.fibres.size(), 8 * s.mesh.cells.size());
  for (const YarnBody& b : s.bodies)
    for (int e = b.first_cell; e < b.end_cell; ++e)
      for (int g = 0; g < 8; ++g) {
        // The place along the cloth by the section that stands there: the Gauss point is between two.
        const int section = (e - b.first_cell) / 4;
        const double at = (section + 0.5 * (1 + hexahedronPoints()[g].x)) / 5;
        const Vec3 fibre = s.mesh.fibres[8 * e + g];
        EXPECT_NEAR(norm(fibre), 1, 1e-14);
        EXPECT_NEAR(fibre.z / fibre[b.direction], yarns.slope(b.direction, b.yarn, at), 1e-13);
        EXPECT_EQ(fibre[1 - b.direction], 0);
      }
}

TEST(SolidYarns, TouchWhereTheyCrossAndPassNowhere) {
  const SolidYarns s = solidYarns(woven(), {kYarn, kYarn}, {4, 13}, true);
  double weft_lowest = 1, warp_highest = -1;
  for (const YarnBody& b : s.bodies)
    for (int l = 0; l < b.sections; ++l)
      for (int i = 0; i <= 4; ++i) {
        const Vec3 low = s.mesh.nodes[s.node(b, l, i, 0)], high = s.mesh.nodes[s.node(b, l, i, 4)];
        EXPECT_GT(high.z, low.z);
        const bool crossing = std::abs(low[b.direction] - 0.5) < 0.05 && i == 2;
        if (b.direction == along_weft && crossing) weft_lowest = std::min(weft_lowest, std::min(low.z, high.z));
        if (b.direction == along_warp && crossing) warp_highest = std::max(warp_highest, high.z);
      }
  // One of the two is on top; the middles of both are within half a piece of the crossing.
  const double drop = 0.16 * (1 - std::cos(std::numbers::pi * 0.5 / 13));
  const bool weft_on_top = woven().onTop(along_weft, 0, 0);
  EXPECT_NEAR(weft_on_top ? weft_lowest : -weft_lowest, weft_on_top ? 0 : 0.32, 4 * drop);
  EXPECT_NEAR(weft_on_top ? warp_highest : 0, 0, 4 * drop);
}

TEST(SolidYarns, SkinsAreTheSidesSeenFromOutside) {
  const SolidYarns s = solidYarns(woven(), {kYarn, kYarn}, {3, 5}, true);
  for (const YarnBody& b : s.bodies) {
    const std::vector<Facet> skin = s.skin(b);
    EXPECT_EQ(skin.size(), 4u * 3 * 5);
    std::set<int> nodes;
    for (const Facet& f : skin) {
      nodes.insert(f.begin(), f.end());
      const Vec3 n = cross(s.mesh.nodes[f[2]] - s.mesh.nodes[f[0]], s.mesh.nodes[f[3]] - s.mesh.nodes[f[1]]);
      Vec3 at{};
      for (const int i : f) at += 0.25 * s.mesh.nodes[i];
      const Vec3 middle = woven().middle(b.direction, b.yarn, at[b.direction]);
      EXPECT_GT(dot(n, at - middle), 0);
    }
    EXPECT_EQ(nodes.size(), 4u * 3 * 6);
  }
}

std::string keyOf(const WovenYarns& yarns, const YarnMeshing& meshing, bool quarter) {
  try {
    solidYarns(yarns, {kYarn, kYarn}, meshing, quarter);
  } catch (const InputError& e) {
    return e.where().key;
  }
  return "";
}

TEST(SolidYarns, BadInputNamesItsKey) {
  EXPECT_EQ(keyOf(woven(), {2, 5}, true), "");
  EXPECT_EQ(keyOf(woven(), {1, 5}, true), "across");
  EXPECT_EQ(keyOf(woven(), {17, 5}, true), "across");
  EXPECT_EQ(keyOf(woven(), {2, 6}, true), "along");
  EXPECT_EQ(keyOf(woven(), {2, 3}, true), "along");
  EXPECT_EQ(keyOf(woven(twillWeave(2, 2)), {2, 5}, true), "extent");
  WovenYarns wide = woven();
  wide.yarn[along_warp].half_width_m = 0.6;
  EXPECT_EQ(keyOf(wide, {2, 5}, true), "warp.half_width");
}

}  // namespace
}  // namespace gambeson
