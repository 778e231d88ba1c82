// Drafts laid flat: what can be developed keeps its lengths, what cannot says by how much.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "tryon/pattern/armour.hpp"
#include "tryon/pattern/fit.hpp"
#include "tryon/pattern/flat/flatten_draft.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace {

constexpr double pi = std::numbers::pi;

double sideOf(const FlatPatch& f, bool top) {
  double length = 0;
  const int j = top ? static_cast<int>(f.v.size()) - 1 : 0;
  for (std::size_t i = 1; i < f.u.size(); ++i) {
    const Vec2 &a = f.at(static_cast<int>(i) - 1, j), &b = f.at(static_cast<int>(i), j);
    length += std::hypot(b.x - a.x, b.y - a.y);
  }
  return length;
}

// A cone: half opening angle a, slant from 0.5 to 1 m, a quarter turn. Its development is a sector of angle
// pi / 2 sin(a): sides of 0.5 and 1 times that.
TEST(Flatten, AConeIsASector) {
  const double a = 0.3;
  const auto cone = [&](double s, double t) {
    const double l = 1 - 0.5 * t, phi = 0.5 * pi * s;
    return Vec3{l * std::sin(a) * std::cos(phi), l * std::sin(a) * std::sin(phi), -l * std::cos(a)};
  };
  double worst = 1;
  for (const int cells : {8, 16}) {
    const FlatPatch f = flattenPatch(interpolate(uniformKnots(3, cells), uniformKnots(3, cells), cone));
    const double sector = 0.5 * pi * std::sin(a);
    const double off =
        std::max(std::abs(sideOf(f, false) / sector - 1), std::abs(sideOf(f, true) / (0.5 * sector) - 1));
    EXPECT_LT(off, 1e-4);
    EXPECT_LT(f.flattening.largest_strain, 1e-3);
    EXPECT_LT(std::abs(f.flattening.area_change), 1e-5);
    EXPECT_LT(off, 0.5 * worst) << "converges";
    worst = off;
  }
}

// A spherical square of half angle b about the equator cannot be developed. Gauss-Bonnet: its flat image misses the
// angle excess, and the strain of the best map grows with K L^2: four times smaller for half the size.
TEST(Flatten, ASphereIsStrainedAsItsCurvatureSays) {
  const auto strainOf = [](double b) {
    const auto sphere = [&](double s, double t) {
      const double p = b * (2 * s - 1), q = b * (2 * t - 1);
      return Vec3{std::cos(p) * std::cos(q), std::sin(p) * std::cos(q), std::sin(q)};
    };
    return flattenPatch(interpolate(uniformKnots(3, 8), uniformKnots(3, 8), sphere)).flattening.rms_strain;
  };
  const double large = strainOf(0.4), small = strainOf(0.2);
  EXPECT_GT(large, 5e-3);
  EXPECT_LT(large, 5e-2);
  EXPECT_NEAR(large / small, 4, 0.3);
}

TEST(FlattenDraft, ATubeIsRectangles) {
  TubePattern tube;
  tube.radius_m = 0.1, tube.length_m = 0.3, tube.patches = 2, tube.degree = 3;
  const FlattenedDraft flat = flattenDraft(makeTube(tube));
  ASSERT_EQ(flat.pattern.panels.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT(flat.flattening[k].largest_strain, 1e-4);
    EXPECT_NEAR(areaOf(flat.pattern.panels[k]), pi * 0.1 * 0.3, 1e-4 * pi * 0.03);
    EXPECT_EQ(flat.pattern.panels[k].outline.size(), 4u);
  }
  ASSERT_EQ(flat.pattern.seams.size(), 2u);
  for (const PanelSeam& s : flat.pattern.seams) {
    EXPECT_NEAR(lengthOf(flat.pattern, s.a), 0.3, 1e-6);
    EXPECT_NEAR(lengthOf(flat.pattern, s.b), 0.3, 1e-6);
  }
}

TEST(FlattenDraft, ShortsHaveTheirSeamsAndMirrorEachOther) {
  ShortsPattern p;
  p.cell_m = 0.04;
  const Garment shorts = makeShorts(p, makeManikin("male_p50"));
  const FlattenedDraft flat = flattenDraft(shorts);
  ASSERT_EQ(flat.pattern.panels.size(), 6u);
  ASSERT_EQ(flat.pattern.seams.size(), shorts.seams.size());
  for (int left : {trunk_left, outer_left, inner_left}) {
    EXPECT_NEAR(areaOf(flat.pattern.panels[left]) / areaOf(flat.pattern.panels[left + 1]), 1, 1e-6);
    EXPECT_GT(flat.flattening[left].largest_strain, 1e-4);  // a seat is round
    EXPECT_LT(flat.flattening[left].largest_strain, 0.3);
  }
  // The weft runs upward, so the warp lies across.
  for (const Panel& panel : flat.pattern.panels) {
    ASSERT_TRUE(panel.grain);
    EXPECT_LT(std::abs(panel.grain->to_m.y - panel.grain->from_m.y),
              0.35 * std::abs(panel.grain->to_m.x - panel.grain->from_m.x))
        << panel.name;
  }
  EXPECT_EQ(flat.pattern.panels[trunk_left].outline[2].name, "waist");
  EXPECT_EQ(flat.pattern.panels[outer_left].outline[0].name, "hem_left");
  for (const PanelSeam& s : flat.pattern.seams) {
    const double a = lengthOf(flat.pattern, s.a), b = lengthOf(flat.pattern, s.b);
    EXPECT_NEAR(a / b, 1, 0.1) << s.name;
  }
}

// The neckline is cut out of the front's upper edge; straps lie beside it on parts of that edge.
TEST(FlattenDraft, AShirtHasItsNeckline) {
  const Human human = makeManikin("female_p50");
  const BodyForm form(human);
  ShirtPattern p;
  p.cell_m = 0.035;
  const FlattenedDraft flat = flattenDraft(makeShirt(p, form, 1e-3, {}));
  ASSERT_EQ(flat.pattern.panels.size(), 6u);
  const Panel& neck = flat.pattern.panels[front];
  EXPECT_EQ(neck.outline.size(), 7u);  // hem, two sides, two parts of the upper edge, two curves of the neckline
  EXPECT_TRUE(neck.cutouts.empty());
  EXPECT_EQ(flat.pattern.seams.size(), 8u);
  for (const PanelSeam& s : flat.pattern.seams)
    EXPECT_NEAR(lengthOf(flat.pattern, s.a) / lengthOf(flat.pattern, s.b), 1, 0.05) << s.name;
}

// Four pieces each: their seams name the armhole, piece by piece, and those along the arm.
TEST(FlattenDraft, SleevesAreSewnIntoArmholes) {
  const Human human = makeManikin("female_p50");
  const BodyForm form(human);
  ShirtPattern p;
  p.cell_m = 0.035;
  p.sleeve_length_m = 0.45;
  const Garment shirt = makeShirt(p, form, 1e-3, {});
  const FlattenedDraft flat = flattenDraft(shirt);
  ASSERT_EQ(flat.pattern.panels.size(), 14u);
  ASSERT_EQ(flat.pattern.seams.size(), 8u + 2 * 8u);
  for (int k = 0; k < 4; ++k) {
    const int left = sleeve_front_left + k, right = sleeve_front_right + k;
    EXPECT_NEAR(areaOf(flat.pattern.panels[left]) / areaOf(flat.pattern.panels[right]), 1, 1e-2);
    EXPECT_EQ(flat.pattern.panels[left].outline[0].name, "cuff_left");
    EXPECT_EQ(flat.pattern.panels[right].outline[0].name, "cuff_right");
    EXPECT_LT(flat.flattening[left].rms_strain, left == sleeve_top_left ? 0.1 : 0.02) << k;  // a shoulder is round
  }
  int armhole = 0;
  for (const PanelSeam& s : flat.pattern.seams) {
    const bool cap = s.a.front().panel == sleeve_top_left || s.a.front().panel == sleeve_top_right;
    EXPECT_NEAR(lengthOf(flat.pattern, s.a) / lengthOf(flat.pattern, s.b), 1, cap ? 0.4 : 0.1) << s.name;
    armhole += s.a.front().panel >= sleeve_front_left && s.b.front().panel < sleeve_front_left;
  }
  EXPECT_EQ(armhole, 8);
}

}  // namespace
}  // namespace gambeson
