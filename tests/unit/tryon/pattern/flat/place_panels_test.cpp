/// Panels around a wearer by their regions: free of the body and each other, seams face each other, heights as named.
#include "tryon/pattern/flat/place_panels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/contact/proximity.hpp"
#include "core/error.hpp"
#include "human/body/section.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/standing.hpp"
#include "tryon/pattern/flat/panel_fit.hpp"
#include "unit/tryon/pattern/flat/region_patterns.hpp"

namespace gambeson {
namespace {

using namespace region_patterns;

constexpr double kAside = 40 * std::numbers::pi / 180;

/// A size about right for a manikin, by its stature and chest.
Size sizeFor(const StandingBody& form) {
  Size s;
  s.scale = form.human().stature_m / 1.76;
  const double chest =
      tapeGirth(form.level(form.origin(form.links({"torso"})[0]).z + 0.25 * s.scale, form.links({"torso"})));
  s.quarter_chest = 0.29 * chest / s.scale;
  return s;
}

struct Faced {
  double widest_m = 0, mean_m = 0;
};
Faced facing(const FlatPattern& p, const PlacedPanels& placed) {
  Faced f;
  double length = 0;
  for (const SeamPair& s : seamPairs(p)) {
    const double d =
        norm(placed.bent[static_cast<std::size_t>(s.a)](s.xa) - placed.bent[static_cast<std::size_t>(s.b)](s.xb));
    f.widest_m = std::max(f.widest_m, d);
    f.mean_m += d * s.length_m, length += s.length_m;
  }
  f.mean_m /= length;
  return f;
}

TEST(PlacePanels, StandFreeOfEveryManikinAndFaceEachOther) {
  const struct {
    const char* name;
    FlatPattern (*make)(const Size&);
    double widest_m, mean_m;
  } garments[] = {{"skirt", skirt, 0.2, 0.13},
                  {"shirt", shirt, 0.35, 0.16},
                  {"trousers", trousers, 0.45, 0.22},
                  {"jumpsuit", jumpsuit, 0.45, 0.2}};
  for (const std::string& manikin : manikinNames()) {
    const Human human = makeManikin(manikin);
    for (const auto& garment : garments) {
      const StandingBody form(human, withArmsAside(human, standing(human), kAside));
      const FlatPattern p = garment.make(sizeFor(form));
      const PlacedPanels placed = placePanels(p, form);
      for (std::size_t k = 0; k < p.panels.size(); ++k)
        EXPECT_LT(depthInBody(p.panels[k], placed.bent[k], form).depth_m, -0.002)
            << manikin << " " << garment.name << " " << p.panels[k].name;
      const Faced f = facing(p, placed);
      EXPECT_LT(f.widest_m, garment.widest_m) << manikin << " " << garment.name;
      EXPECT_LT(f.mean_m, garment.mean_m) << manikin << " " << garment.name;
      std::printf("%-11s %-9s seams face each other at %.3f m, at most %.3f m\n", manikin.c_str(), garment.name,
                  f.mean_m, f.widest_m);
    }
  }
}

/// However wide they are, a plane stays free between what stands in front and what stands behind.
TEST(PlacePanels, FrontAndBackNeverMeet) {
  const Human human = makeManikin("female_p50");
  const StandingBody form(human, standing(human));
  for (const double hem : {0.2, 0.3, 0.45, 0.8}) {
    Size s;
    s.quarter_hem = hem;
    const FlatPattern p = skirt(s);
    const PlacedPanels placed = placePanels(p, form);
    double front = 1e300, back = -1e300;
    for (double y = 0; y <= 0.5; y += 0.05)
      for (double x = -hem; x <= hem; x += 0.02) {
        front = std::min(front, placed.bent[0]({x, y}).x);
        back = std::max(back, placed.bent[1]({x, y}).x);
      }
    EXPECT_GT(front - back, 0.03) << hem;
  }
}

/// Bent about one direction the sheets keep their lengths, and their right sides look away from the body.
TEST(PlacePanels, AreBentWithoutStrainTheirRightSidesOut) {
  const Human human = makeManikin("female_p50");
  const StandingBody form(human, withArmsAside(human, standing(human), kAside));
  const FlatPattern p = jumpsuit(sizeFor(form));
  const PlacedPanels placed = placePanels(p, form);
  for (std::size_t k = 0; k < p.panels.size(); ++k) {
    const PanelBox box = boxOf(p.panels[k].outline);
    const auto& at = placed.bent[k];
    constexpr double h = 0.01;
    for (double x = box.low.x; x < box.high.x; x += 0.03)
      for (double y = box.low.y; y < box.high.y; y += 0.05) {
        const Vec3 u = at({x + h, y}) - at({x, y}), v = at({x, y + h}) - at({x, y});
        EXPECT_NEAR(norm(u), h, 0.01 * h) << p.panels[k].name;
        EXPECT_NEAR(norm(v), h, 0.01 * h) << p.panels[k].name;
        EXPECT_NEAR(dot(u, v), 0, 0.01 * h * h) << p.panels[k].name;
      }
    const Vec2 m{0.5 * (box.low.x + box.high.x), 0.5 * (box.low.y + box.high.y)};
    const Vec3 out = cross(at({m.x + h, m.y}) - at(m), at({m.x, m.y + h}) - at(m)) / (h * h);
    const std::string& name = p.panels[k].name;
    const Vec3 away = name == "left sleeve"     ? Vec3{0, 1, 0}
                      : name == "right sleeve"  ? Vec3{0, -1, 0}
                      : name.ends_with("front") ? Vec3{1, 0, 0}
                                                : Vec3{-1, 0, 0};
    EXPECT_GT(dot(out, away), 0.5) << name;
    EXPECT_GT(dot(cross(placed.flat[k].along_x, placed.flat[k].along_y), normalized(out)), 0.95) << name;
  }
}

TEST(PlacePanels, ShouldersCrotchAndWaistTellTheHeight) {
  const Human human = makeManikin("male_p50");
  const StandingBody form(human, withArmsAside(human, standing(human), kAside));
  const Size size = sizeFor(form);
  const double shoulder = form.origin(form.links({"upper_arm_left"})[0]).z;
  const FlatPattern p = shirt(size);
  const PlacedPanels worn = placePanels(p, form);
  for (std::size_t face = 0; face < 2; ++face) {
    const Vec3 middle =
        0.5 * (worn.bent[face](p.panels[face].outline[3].start_m) + worn.bent[face](p.panels[face].outline[4].start_m));
    EXPECT_GT(middle.z, shoulder) << "on the shoulder";
    EXPECT_LT(middle.z, shoulder + 0.12);
  }
  // The arm side of each seam is where its panel is: the left sleeve at the left, its cap at the shoulder.
  EXPECT_GT(worn.bent[2](p.panels[2].outline[3].start_m).y, 0.15);
  EXPECT_LT(worn.bent[3](p.panels[3].outline[3].start_m).y, -0.15);
  EXPECT_NEAR(worn.bent[2](p.panels[2].outline[3].start_m).z, shoulder, 0.2);
  EXPECT_LT(worn.bent[2](p.panels[2].outline[0].start_m).z, shoulder - 0.3) << "the hem at the hand";

  const FlatPattern t = trousers(size);
  const PlacedPanels legs = placePanels(t, form);
  const double crotch = form.lowest(form.links({"pelvis"}));
  EXPECT_NEAR(legs.bent[0](t.panels[0].outline[4].start_m).z, crotch - 0.01, 0.003);
  EXPECT_NEAR(legs.bent[3](t.panels[3].outline[4].start_m).z, crotch - 0.01, 0.003);
  EXPECT_GT(legs.bent[0](t.panels[0].outline[1].start_m).y, 0.1) << "the left leg's outer side is at the left";
  EXPECT_GT(legs.bent[2](t.panels[2].outline[0].start_m).y, 0.1);

  const FlatPattern s = skirt(size);
  const PlacedPanels hung = placePanels(s, form);
  const double lumbar = form.origin(form.links({"torso"})[0]).z;
  EXPECT_NEAR(hung.bent[0](s.panels[0].outline[2].start_m).z, lumbar + 0.04, 0.04);
}

/// Upright by the grain, however a piece was drawn: a lying shirt is worn as the standing one.
TEST(PlacePanels, AGrainLineTurnsWhatWasDrawnLying) {
  const Human human = makeManikin("male_p50");
  const StandingBody form(human, withArmsAside(human, standing(human), kAside));
  FlatPattern p = shirt(sizeFor(form));
  const PlacedPanels standing_up = placePanels(p, form);
  for (Panel& panel : p.panels) {
    const auto turn = [](Vec2& x) { x = {x.y, -x.x}; };
    for (PanelEdge& e : panel.outline) {
      turn(e.start_m);
      if (auto* b = std::get_if<BezierEdge>(&e.curve))
        for (Vec2& c : b->controls_m) turn(c);
    }
    panel.grain = GrainLine{{0.2, 0}, {0.4, 0}};
  }
  const PlacedPanels lying = placePanels(p, form);
  for (std::size_t k = 0; k < p.panels.size(); ++k) {
    const Vec2 x{0.05, 0.3};
    EXPECT_LT(norm(lying.bent[k]({x.y, -x.x}) - standing_up.bent[k](x)), 1e-6) << p.panels[k].name;
  }
}

/// Fronts that are not sewn to each other stand side by side, the left one at the left.
TEST(PlacePanels, HalvesOfARegionShareItsPlace) {
  const Human human = makeManikin("male_p50");
  const StandingBody form(human, standing(human));
  FlatPattern p;
  const auto square = [](const char* name, const char* region) {
    return panel(name, region, {edge(0, 0), edge(0.24, 0), edge(0.24, 0.5), edge(0, 0.5)});
  };
  p.panels = {square("lf", "left_front"), square("rf", "right_front"), square("b", "back"), square("b2", "back"),
              square("b3", "back")};
  p.seams = {{"left", {{0, 1, 0, 1}}, {{2, 3, 1, 0}}},
             {"right", {{4, 1, 0, 1}}, {{1, 3, 1, 0}}},
             {"back left", {{2, 1, 0, 1}}, {{3, 3, 1, 0}}},
             {"back right", {{3, 1, 0, 1}}, {{4, 3, 1, 0}}}};
  checkPattern(p);
  const PlacedPanels placed = placePanels(p, form);
  const auto y = [&](std::size_t k) { return placed.bent[k]({0.12, 0.25}).y; };
  EXPECT_GT(y(0), 0.05);
  EXPECT_LT(y(1), -0.05);
  EXPECT_GT(y(2), y(3) + 0.1) << "behind, the first is at the left";
  EXPECT_GT(y(3), y(4) + 0.1);
  EXPECT_NEAR(placed.bent[0]({0, 0.5}).z, placed.bent[3]({0, 0.5}).z, 1e-9);
}

TEST(PlacePanels, WhatHasNoPlaceIsRefused) {
  const Human human = makeManikin("male_p50");
  const StandingBody form(human, standing(human));
  const auto refusal = [&](const FlatPattern& p, std::string& key) {
    try {
      placePanels(p, form);
    } catch (const InputError& e) {
      key = e.where().key;
      return e.reason();
    }
    return std::string();
  };
  std::string key;
  FlatPattern p = skirt({});
  p.panels[1].region = "somewhere";
  EXPECT_NE(refusal(p, key).find("\"back\" has no region"), std::string::npos);
  EXPECT_EQ(key, "panels[1]");
  // Between two walls as wide as the arms reach there is no room for a wide sleeve.
  FlatPattern walled;
  walled.panels = {panel("wall", "front", {edge(-1, 0), edge(1, 0), edge(1, 1.6), edge(-1, 1.6)}),
                   panel("other wall", "back", {edge(-1, 0), edge(1, 0), edge(1, 1.6), edge(-1, 1.6)}),
                   panel("wide", "left_sleeve", {edge(-0.6, 0), edge(0.6, 0), edge(0.6, 0.6), edge(-0.6, 0.6)})};
  walled.seams = {{"", {{0, 2, 0, 1}}, {{1, 2, 1, 0}}}};
  const std::string no_room = refusal(walled, key);
  EXPECT_NE(no_room.find("panel \"wide\" finds no room around the left arm"), std::string::npos) << no_room;
  EXPECT_EQ(key, "panels[2]");
}

/// A bodice and a skirt with a band between them: it stands between them, around the waist.
TEST(PlacePanels, AWaistbandStaysAtTheWaist) {
  for (const char* manikin : {"male_p50", "female_p5"}) {
    const Human human = makeManikin(manikin);
    const StandingBody form(human, withArmsAside(human, standing(human), kAside));
    const Size size = sizeFor(form);
    FlatPattern p;
    p.name = "dress";
    addShirt(p, size, 0.46);
    const FlatPattern below = skirt(size);
    const int skirts = static_cast<int>(p.panels.size()), band = skirts + 2;
    for (Panel panel : below.panels) panel.name = "skirt " + panel.name, p.panels.push_back(panel);
    for (PanelSeam seam : below.seams) {
      seam.name += " of the skirt";
      for (auto* side : {&seam.a, &seam.b}) (*side)[0].panel += skirts;
      p.seams.push_back(seam);
    }
    const double w = 2 * size.scale * size.quarter_waist, h = 0.06;
    p.panels.push_back(panel("band", "waistband", {edge(0, 0), edge(2 * w, 0), edge(2 * w, h), edge(0, h)}));
    p.seams.push_back({"lower front", {{band, 0, 0, 0.5}}, {{skirts, 2, 0, 1}}});
    p.seams.push_back({"lower back", {{band, 0, 0.5, 1}}, {{skirts + 1, 2, 0, 1}}});
    p.seams.push_back({"upper front", {{band, 2, 1, 0.5}}, {{0, 0, 1, 0}}});
    p.seams.push_back({"upper back", {{band, 2, 0.5, 0}}, {{1, 0, 1, 0}}});
    checkPattern(p);
    const PlacedPanels placed = placePanels(p, form);
    const auto z = [&](int k, Vec2 x) { return placed.bent[static_cast<std::size_t>(k)](x).z; };
    const double low = z(band, {w, 0}), high = z(band, {w, h});
    const double hem = std::min(z(0, {0, 0}), z(1, {0, 0})), top = z(skirts, {0, size.scale * 0.5});
    EXPECT_LT(high, hem) << manikin << ": below the bodice";
    EXPECT_GT(low, top) << manikin << ": above the skirt";
    const double lumbar = form.origin(form.links({"torso"})[0]).z;
    EXPECT_NEAR(low, lumbar + 0.04, 0.12) << manikin;
    EXPECT_LT(depthInBody(p.panels[static_cast<std::size_t>(band)], placed.bent[static_cast<std::size_t>(band)], form)
                  .depth_m,
              -0.002);
  }
}

/// A waistband of two pieces, sewn to each other in front and behind: both stand at the same height, above the skirt.
TEST(PlacePanels, ShortEndsOfABandAreNotItsLowerEdge) {
  const Human human = makeManikin("female_p50");
  const StandingBody form(human, standing(human));
  const Size size = sizeFor(form);
  FlatPattern p = skirt(size);
  const double w = 2 * size.scale * size.quarter_waist, h = 0.06;
  for (const char* name : {"left band", "right band"})
    p.panels.push_back(panel(name, "waistband", {edge(0, 0), edge(w, 0), edge(w, h), edge(0, h)}));
  p.seams.push_back({"left front", {{2, 0, 0, 0.5}}, {{0, 2, 0.5, 0}}});
  p.seams.push_back({"left back", {{2, 0, 0.5, 1}}, {{1, 2, 1, 0.5}}});
  p.seams.push_back({"right back", {{3, 0, 0, 0.5}}, {{1, 2, 0.5, 0}}});
  p.seams.push_back({"right front", {{3, 0, 0.5, 1}}, {{0, 2, 1, 0.5}}});
  p.seams.push_back({"centre back", {{2, 1, 0, 1}}, {{3, 3, 1, 0}}});
  p.seams.push_back({"centre front", {{3, 1, 0, 1}}, {{2, 3, 1, 0}}});
  checkPattern(p);
  const PlacedPanels placed = placePanels(p, form);
  const auto z = [&](std::size_t k, Vec2 x) { return placed.bent[k](x).z; };
  EXPECT_NEAR(z(3, {0.5 * w, 0}), z(2, {0.5 * w, 0}), 1e-9);
  EXPECT_GT(z(3, {0.5 * w, 0}), z(0, p.panels[0].outline[2].start_m));
  EXPECT_LT(z(3, {0.5 * w, 0}), z(0, p.panels[0].outline[2].start_m) + h);
  EXPECT_GT(placed.bent[2]({0.5 * w, 0}).y, 0.05);
  EXPECT_LT(placed.bent[3]({0.5 * w, 0}).y, -0.05);
}

/// Arms of a scan may hang no lower than its trunk and sleeves let them.
TEST(PlacePanels, ArmsThatCannotHangAreNotBroughtIn) {
  Human human = makeManikin("male_p50");
  const auto shoulder = static_cast<std::size_t>(human.skeleton.joint("shoulder_abduction_left"));
  human.skeleton.joints[shoulder].lower = 1;
  EXPECT_EQ(withArmsAside(human, standing(human), kAside).q[shoulder], 1);
  EXPECT_EQ(withArmsAside(human, standing(human), 1.2).q[shoulder], 1.2);
}

/// Seams close along straight lines: what is to be a tube around the arm has its edges beyond the arm.
TEST(PlacePanels, EdgesOfASleeveLieUnderTheArm) {
  int looked = 0;
  for (const char* name : {"male_p50", "female_p50"}) {
    const Human human = makeManikin(name);
    const StandingBody form(human, withArmsAside(human, standing(human), kAside));
    FlatPattern p = shirt(sizeFor(form));
    p.seams.clear();
    for (std::size_t k = 2; k < 4; ++k)
      for (PanelEdge& e : p.panels[k].outline) e.start_m.x *= 1.6;  // 38 cm around the wrist
    const PlacedPanels placed = placePanels(p, form);
    for (std::size_t k = 2; k < 4; ++k) {
      const std::string side = k == 2 ? "left" : "right";
      const StandingBody::Links arm{form.link("upper_arm_" + side), form.link("forearm_" + side)};
      const Vec3 shoulder = form.origin(arm[0]), hand = form.origin(form.link("hand_" + side));
      const Vec3 way = normalized(hand - shoulder), outward{0, k == 2 ? 1.0 : -1.0, 0};
      const Vec3 out = normalized(outward - dot(outward, way) * way);
      for (const double up : {0.0, 0.3}) {  // part of the way from the hem to the cap's start
        const PanelLoop& edges = p.panels[k].outline;
        const auto at = [&](std::size_t low, std::size_t high) {
          const Vec2 a = edges[low].start_m, b = edges[high].start_m;
          return placed.bent[k]({a.x + up * (b.x - a.x), a.y + up * (b.y - a.y)});
        };
        const Vec3 middle = 0.5 * (at(0, 4) + at(1, 2));
        double deepest = 1e300;  // of the arm beside it
        for (const Vec3& x : form.points(arm))
          if (std::abs(dot(x - middle, way)) < 0.03) deepest = std::min(deepest, dot(x, out));
        if (deepest > 1e299) continue;  // beside the hand
        ++looked;
        EXPECT_LT(dot(middle, out), deepest + 0.02) << name << ", " << side << ", " << up;
      }
    }
  }
  EXPECT_GE(looked, 6);
}

/// Arms straight to the sides, and straight forward: the sleeve lies along the arm, open where the trunk is.
TEST(PlacePanels, SleevesGoAlongArmsThatAreRaised) {
  const Human human = makeManikin("male_p50");
  for (const bool forward : {false, true}) {
    Posture posture = standing(human);
    if (!forward) posture = withArmsAside(human, posture, 0.5 * std::numbers::pi);
    if (forward)
      for (const std::string side : {"left", "right"}) {
        const auto joint = [&](const std::string& name) -> double& {
          return posture.q[static_cast<std::size_t>(human.skeleton.joint(name + side))];
        };
        joint("shoulder_abduction_") = 0;
        joint("shoulder_flexion_") = 0.5 * std::numbers::pi;
      }
    const StandingBody form(human, posture);
    const FlatPattern whole = shirt(sizeFor(form));
    FlatPattern p = whole;
    if (forward) p.panels = {whole.panels[2], whole.panels[3]}, p.seams.clear();  // arms are where the front would hang
    const PlacedPanels placed = placePanels(p, form);
    for (std::size_t k = p.panels.size() - 2; k < p.panels.size(); ++k) {
      const bool is_left = k + 2 == p.panels.size();
      const char* side = is_left ? "left" : "right";
      const Vec3 shoulder = form.origin(form.link(std::string("upper_arm_") + side));
      const Vec3 hand = form.origin(form.link(std::string("hand_") + side));
      const Vec3 way = normalized(hand - shoulder), hem = placed.bent[k]({0, 0}), cap = placed.bent[k]({0, 0.4});
      ASSERT_TRUE(std::isfinite(norm(hem) + norm(cap))) << side;
      EXPECT_GT(dot(normalized(hem - cap), way), 0.999) << side;
      const Vec3 arm = 0.5 * (shoulder + hand), off = hem - arm - dot(hem - arm, way) * way;
      // Off the trunk: up where the arm is raised to the side, outward where it is raised forward.
      const Vec3 out = forward ? Vec3{0, is_left ? 1.0 : -1.0, 0} : Vec3{0, 0, 1};
      EXPECT_GT(dot(normalized(off), out), 0.9) << side << (forward ? ", forward" : ", to the side");
    }
  }
}

/// Rectangles that are 4 cm narrower around than the hips are said to be, by the tape's own number.
TEST(PanelFit, TellsWhereAndByHowMuch) {
  const Human human = makeManikin("female_p50");
  const StandingBody form(human, standing(human));
  const StandingBody::Links around = form.links({"pelvis", "torso", "thigh_left", "thigh_right"});
  const double hip = form.origin(around[2]).z, girth = tapeGirth(form.level(hip, around));
  Size s;
  s.quarter_waist = s.quarter_hem = 0.25 * (girth - 0.04);
  FlatPattern p = skirt(s);
  const PlacedPanels placed = placePanels(p, form);
  bool found = false;
  for (const PanelGirth& g : panelGirths(p, placed.front, placed.back, form)) {
    if (g.where != "hip") continue;
    found = true;
    EXPECT_NEAR(g.height_m, hip, 1e-9);
    EXPECT_NEAR(g.body_m, girth, 1e-9);
    EXPECT_NEAR(g.short_m(), 0.04, 1e-6);
  }
  EXPECT_TRUE(found);
  const std::string text = shortText(panelGirths(p, placed.front, placed.back, form));
  EXPECT_NE(text.find("at the hip"), std::string::npos) << text;
  EXPECT_NE(text.find("4.0 cm short"), std::string::npos) << text;
  s.quarter_waist = s.quarter_hem = 0.25 * (girth + 0.04);
  p = skirt(s);
  const PlacedPanels wider = placePanels(p, form);
  EXPECT_EQ(shortText(panelGirths(p, wider.front, wider.back, form)), "");
}

/// A panel whose outline is cut in by 20 cm over 2 cm of height, without a seam around the body there.
TEST(PanelFit, ANarrowLevelIsSaid) {
  const Human human = makeManikin("female_p50");
  const StandingBody form(human, standing(human));
  const StandingBody::Links around = form.links({"pelvis", "torso", "thigh_left", "thigh_right"});
  const double hip = form.origin(around[2]).z, girth = tapeGirth(form.level(hip, around));
  Size s;
  s.quarter_waist = s.quarter_hem = 0.25 * (girth + 0.01);
  const FlatPattern p = skirt(s);
  PlacedPanels placed = placePanels(p, form);
  EXPECT_EQ(shortText(panelGirths(p, placed.front, placed.back, form)).find("at the hip"), std::string::npos);
  std::vector<Vec2>& outline = placed.front[0].outline;
  std::size_t left = 0;  // begin of the edge that passes the hip at the left
  double least = 1e300;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2 a = outline[k], b = outline[(k + 1) % outline.size()];
    if ((a.y - hip) * (b.y - hip) < 0 && std::min(a.x, b.x) < least) left = k, least = std::min(a.x, b.x);
  }
  const Vec2 a = outline[left], b = outline[(left + 1) % outline.size()];
  const double up = b.y > a.y ? 0.01 : -0.01;
  const auto on = [&](double y) { return a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y); };
  const std::vector<Vec2> cut = {{on(hip - up), hip - up}, {on(hip) + 0.2, hip}, {on(hip + up), hip + up}};
  outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(left) + 1, cut.begin(), cut.end());
  const std::string text = shortText(panelGirths(p, placed.front, placed.back, form));
  EXPECT_NE(text.find("at the hip"), std::string::npos) << text;
}

}  // namespace
}  // namespace gambeson
