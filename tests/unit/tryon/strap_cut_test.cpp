#include "tryon/strap_cut.hpp"

#include <gtest/gtest.h>

#include <random>

#include "core/cloth/shell/nurbs_shell.hpp"

namespace gambeson {
namespace {

constexpr double kThick_m = 2e-3, kYoung_Pa = 1.44e6, kWidth_m = 0.05;

Fabric cloth() {
  Fabric f;
  f.thickness_m = kThick_m;
  f.density_kg_per_m3 = 1440;
  f.young_weft_Pa = f.young_warp_Pa = kYoung_Pa;
  f.shear_Pa = kYoung_Pa / 2;
  f.law = LinearBending{{4e-3, 4e-3}};
  return f;
}

NurbsPatch strip(double from_m, double to_m) {
  NurbsPatch p{uniformKnots(2, 2), uniformKnots(2, 6), {}, {}};
  for (const double v : grevillePoints(p.v))
    for (const double u : grevillePoints(p.u)) p.points.push_back({kWidth_m * u, from_m + (to_m - from_m) * v, 0});
  p.weights.assign(p.points.size(), 1);
  return p;
}

/// Front, strap and back in a row, and another garment's patch.
Garment strapped() {
  Garment g;
  g.fabric = cloth();
  g.patches = {strip(0, 0.2), strip(0.2, 0.4), strip(0.4, 0.6), strip(0, 0.6)};
  g.weft.assign(4, {1, 0, 0});
  g.garment_of_patch = {0, 0, 0, 1};
  g.seams = {{{0, Side::v1}, {1, Side::v0}, SeamKind::C0, 0.01}, {{1, Side::v1}, {2, Side::v0}, SeamKind::C0, 0.01}};
  return g;
}
const std::vector<std::string> names{"shirt front", "shirt strap_left", "shirt back", "belt strap"};

std::vector<Vec3> controls(const Garment& g) {
  std::vector<Vec3> q;
  for (const NurbsPatch& p : g.patches) q.insert(q.end(), p.points.begin(), p.points.end());
  return q;
}

TEST(StrapCut, IsWhereAStrapIsSewn) {
  const std::vector<StrapCut> cuts = strapCuts(NurbsShell(strapped()), names);
  ASSERT_EQ(cuts.size(), 2u);  // the belt's strap is not sewn
  EXPECT_EQ(cuts[0].patch, 1);
  EXPECT_TRUE(!cuts[0].at_end && cuts[1].at_end);
  std::vector<int> first_rows;
  for (int i = 32; i < 40; ++i) first_rows.push_back(i);
  EXPECT_EQ(cuts[0].beyond, first_rows);
  EXPECT_EQ(cuts[1].beyond, (std::vector<int>{60, 61, 62, 63, 56, 57, 58, 59}));
  EXPECT_NEAR(cuts[0].width_m, kWidth_m, 1e-12);
  Garment sleeved = strapped();  // sewn at a third side
  sleeved.patches.push_back(strip(0.2, 0.4));
  for (Vec3& x : sleeved.patches.back().points) x.x += kWidth_m;
  sleeved.weft.push_back({1, 0, 0});
  sleeved.garment_of_patch.push_back(0);
  sleeved.seams.push_back({{4, Side::u0}, {1, Side::u1}, SeamKind::C0, 0.01});
  std::vector<std::string> with_sleeve = names;
  with_sleeve.push_back("shirt sleeve_top_left");
  EXPECT_TRUE(strapCuts(NurbsShell(sleeved), with_sleeve).empty());
  Garment one_end = strapped();
  one_end.seams.pop_back();
  EXPECT_TRUE(strapCuts(NurbsShell(one_end), names).empty());
}

// A stretch of 1 + e along the strap, no Poisson's ratio: n = E h (e + e^2/2) (second Piola-Kirchhoff), and the force
// over the cut (1 + e) n times its width at rest.
TEST(StrapCut, AUniformPullIsItsWidthTimesTheResultant) {
  const Garment g = strapped();
  const NurbsShell shell(g);
  std::vector<Vec3> q = controls(g);
  const double e = 0.02, pull = kWidth_m * (1 + e) * kYoung_Pa * kThick_m * (e + e * e / 2);
  for (Vec3& x : q) x.y *= 1 + e;
  ClothWork work;
  const std::vector<Vec3> f = strapPulls(shell, q, strapCuts(shell, names), work);
  EXPECT_NEAR(f[0].y, pull, 1e-9 * pull);   // the front is pulled up the strap
  EXPECT_NEAR(f[1].y, -pull, 1e-9 * pull);  // the back down it
  EXPECT_NEAR(f[0].x, 0, 1e-9 * pull);
  EXPECT_NEAR(f[0].z, 0, 1e-9 * pull);
}

// Whatever the state: the internal forces of all cells and seams on what lies beyond the cuts are the pulls, nothing
// else; so that its equation of motion closes with them.
TEST(StrapCut, PullsAreAllThatTheInternalForcesDoToWhatHangs) {
  const Garment g = strapped();
  const NurbsShell shell(g);
  std::vector<Vec3> q = controls(g);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-2e-3, 2e-3);
  for (Vec3& x : q) x += Vec3{noise(random), noise(random), noise(random)};
  // Joined edges move together.
  for (int i = 0; i < 4; ++i) {
    q[32 + i] = q[28 + i];
    q[64 + i] = q[60 + i];
  }
  ClothWork work;
  const std::vector<StrapCut> cuts = strapCuts(shell, names);
  const std::vector<double> w = weightsBelow(shell, cuts, false);
  std::vector<Vec3> f(q.size());
  shell.force(q, f, work);
  Vec3 hanging{}, pulls{};
  double size = 0;
  for (std::size_t i = 0; i < q.size(); ++i) hanging += w[i] * f[i], size += norm(f[i]);
  for (const Vec3& p : strapPulls(shell, q, cuts, work)) pulls += p;
  EXPECT_GT(norm(pulls), 1e-4 * size);
  EXPECT_LT(norm(hanging - pulls), 1e-10 * size);
}

TEST(StrapCut, WhatHangs) {
  const NurbsShell g(strapped());
  const std::vector<double> w = weightsBelow(g, strapCuts(g, names), true),
                            all = weightsBelow(g, strapCuts(g, names), false);
  ASSERT_EQ(w.size(), 128u);
  for (int i = 0; i < 128; ++i) EXPECT_EQ(all[i], i < 96 ? w[i] : 1) << i;
  for (int i = 0; i < 32; ++i) {
    EXPECT_EQ(w[i], 1) << i;
    EXPECT_EQ(w[64 + i], 1) << i;
    EXPECT_EQ(w[96 + i], 0) << i;
    EXPECT_EQ(w[32 + i], i < 8 || i >= 24 ? 1 : 0) << i;
  }
}

}  // namespace
}  // namespace gambeson
