/// Girths of worn cloth against those at rest.
#include "tryon/girth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/cloth/shell/nurbs_shell.hpp"
#include "unit/core/cloth/sewn_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr double kWidth = 0.3, kHeight = 0.2;

/// Two flat panels whose cells do not match, sewn to a tube of 60 cm; `open`: but for one seam.
Garment tube(bool open) {
  Fabric fabric;
  fabric.thickness_m = 5e-4, fabric.density_kg_per_m3 = 300;
  fabric.young_weft_Pa = fabric.young_warp_Pa = 1e6, fabric.poisson = 0.2, fabric.shear_Pa = 4e5;
  fabric.law = LinearBending{{1e-5, 1e-5}};
  Garment g = garmentOf({panelPatch(12, 6, {0, 0}, {kWidth, kHeight}), panelPatch(15, 7, {0, 0}, {kWidth, kHeight})},
                        {}, fabric);
  for (Vec3& X : g.patches[1].points) X.z += 0.3;
  g.sewn_seams = {
      {{sidePart(g, {0, Side::u1})}, {sidePart(g, {1, Side::u0})}},
      {{sidePart(g, {0, Side::u0})}, {sidePart(g, {1, Side::u1})}, open ? SeamHold::open : SeamHold::projected}};
  return g;
}

/// Samples at rest, and around a cylinder about z of this girth, up from the height 1 m.
void around(const Garment& g, double girth, Surface& s, std::vector<Vec3>& rest, std::vector<Vec3>& worn) {
  const NurbsShell cloth(g);
  s = cloth.surface(std::vector<int>(2, 2));
  rest.resize(static_cast<std::size_t>(s.size()));
  s.W.multiply<Vec3>(cloth.rest(), rest);
  worn.clear();
  for (int i = 0; i < s.size(); ++i) {
    const Vec2 uv = s.parameters[i];
    const double angle = (uv.x / kWidth + s.patch[i]) * M_PI, r = girth / (2 * M_PI);
    worn.push_back({r * std::cos(angle), r * std::sin(angle), 1 + uv.y});
  }
}

TEST(Girth, OfATubeIsItsWidths) {
  Surface s;
  std::vector<Vec3> rest, worn;
  around(tube(false), 0.66, s, rest, worn);
  const std::vector<Girth> girths = girthsAt(s, rest, worn, {0, 0, 1}, 1.0731);
  ASSERT_EQ(girths.size(), 1u);
  EXPECT_TRUE(girths[0].closed);
  EXPECT_NEAR(girths[0].rest_m, 2 * kWidth, 1e-9);
  EXPECT_NEAR(girths[0].worn_m, 0.66, 2e-3);  // chords
  const std::vector<Girth> found = shortGirths(s, rest, worn, {0, 0, 1}, 0.05);
  ASSERT_EQ(found.size(), 2u);  // 20 cm have two that are 10 cm apart
  EXPECT_NEAR(found[0].short_m(), 0.06, 2e-3);
  EXPECT_NE(shortText(found).find("60.0 cm around and worn 66.0 cm: 6.0 cm short"), std::string::npos)
      << shortText(found);
  EXPECT_TRUE(shortGirths(s, rest, worn, {0, 0, 1}, 0.11).empty());
}

/// A finger is not dressed: what is left of a seam that did not close has such rings, and "0.5 cm around and worn 0.5
/// cm: 0.0 cm short" says nothing.
TEST(Girth, WhatIsTooSmallToBeWornIsNoGirth) {
  Surface s;
  std::vector<Vec3> rest, worn;
  around(tube(false), 0.66, s, rest, worn);
  for (Vec3& p : rest) p = 0.1 * p;
  for (Vec3& p : worn) p = 0.1 * p;
  EXPECT_FALSE(girthsAt(s, rest, worn, {0, 0, 1}, 0.10731).empty());
  EXPECT_TRUE(shortGirths(s, rest, worn, {0, 0, 1}, 0.05, 3, 0.001).empty());
}

TEST(Girth, WhatIsOpenIsNoGirth) {
  Surface s;
  std::vector<Vec3> rest, worn;
  around(tube(true), 0.66, s, rest, worn);
  const std::vector<Girth> girths = girthsAt(s, rest, worn, {0, 0, 1}, 1.0731);
  ASSERT_EQ(girths.size(), 1u);
  EXPECT_FALSE(girths[0].closed);
  EXPECT_TRUE(shortGirths(s, rest, worn, {0, 0, 1}, 0.05).empty());
  EXPECT_EQ(shortText({}), "");
}

}  // namespace
}  // namespace gambeson
