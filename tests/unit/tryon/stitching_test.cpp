// Virtual stitching, Zheng 2013, section 6.3.
#include "tryon/stitching.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/cloth/shell/nurbs_shell.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace {

/// A tube of radius 0.1 m along z, cut into four panels.
Garment tube() {
  TubePattern t;
  t.radius_m = 0.1;
  t.length_m = 0.2;
  t.patches = 4;
  t.cells_around = 24;
  t.cells_along = 8;
  t.axis = {0, 0, 1};
  Garment g = makeTube(t);
  g.fabric.density_kg_per_m3 = 1440;
  g.fabric.thickness_m = 1e-3;
  g.fabric.young_weft_Pa = g.fabric.young_warp_Pa = g.fabric.shear_Pa = 1e6;
  g.fabric.law = LinearBending{};
  return g;
}

TEST(Stitching, PanelsMoveAlongTheirMeanNormal) {
  const Garment g = tube();
  const std::vector<Vec3> offsets = panelOffsets(g, 0.05);
  ASSERT_EQ(offsets.size(), 4u);
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_NEAR(norm(offsets[p]), 0.05, 1e-12);
    Vec3 middle{};
    for (const Vec3& x : g.patches[p].points) middle += x / static_cast<double>(g.patches[p].points.size());
    middle.z = 0;
    EXPECT_GT(dot(normalized(middle), offsets[p]), 0.05 * (1 - 1e-3));
  }
  // A quarter of a tube faces one way to sin(45 deg)/(pi/4) = 0.90.
  for (const Vec3& o : panelOffsets(g, 0.05, 0.95)) EXPECT_EQ(norm(o), 0);
}

TEST(Stitching, EverySeamIsStitchedOverItsLength) {
  const Garment g = tube(), open = unsewn(g);
  EXPECT_TRUE(open.seams.empty());
  const NurbsShell cloth(open);
  const Surface surface = cloth.surface(std::vector<int>(4, 2));
  const std::vector<Stitch> stitches = stitchesOf(g, cloth, surface, {100, 3});
  std::vector<Vec3> X(surface.size());
  surface.W.multiply<Vec3>(cloth.rest(), X);
  double stiffness = 0, damping = 0;
  for (const Stitch& s : stitches) {
    EXPECT_NE(surface.patch[s.a], surface.patch[s.b]);
    EXPECT_LT(norm(X[s.a] - X[s.b]), 1e-12);
    stiffness += s.stiffness_N_per_m;
    damping += s.damping_kg_per_s;
  }
  EXPECT_EQ(stitches.size(), 4u * 17u);
  EXPECT_NEAR(stiffness, 4 * 0.2 * 100, 1e-9);
  EXPECT_NEAR(damping, 4 * 0.2 * 3, 1e-9);
}

TEST(Stitching, SewingKeepsWhatFitsAndMeetsInTheMiddle) {
  const Garment g = tube();
  const FreeMap map = buildFreeMap(g);
  std::vector<Vec3> q;
  for (const NurbsPatch& p : g.patches) q.insert(q.end(), p.points.begin(), p.points.end());
  const std::vector<Vec3> p = sew(map, q);
  std::vector<Vec3> back(q.size());
  map.T.multiply<Vec3>(p, back);
  for (std::size_t i = 0; i < q.size(); ++i) EXPECT_LT(norm(back[i] - q[i]), 1e-12);
  // One panel 2 mm off: nothing moves further than that, and the edges meet.
  const std::vector<int> offsets = controlOffsets(g);
  for (int i = offsets[0]; i < offsets[1]; ++i) q[i] += Vec3{0, 0, 0.002};
  map.T.multiply<Vec3>(sew(map, q), back);
  double largest = 0;
  for (std::size_t i = 0; i < q.size(); ++i) largest = std::max(largest, norm(back[i] - q[i]));
  EXPECT_GT(largest, 0.9e-3);
  EXPECT_LT(largest, 2e-3);
}

}  // namespace
}  // namespace gambeson
