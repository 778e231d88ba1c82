/// Flat panels as cloth: the same areas, lengths and places; what is wrong is named.
#include "tryon/pattern/flat/panel_garment.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/cloth/draft/areas.hpp"
#include "core/cloth/draft/sewing.hpp"
#include "core/error.hpp"
#include "tryon/pattern/flat/panel_check.hpp"
#include "tryon/pattern/flat/panel_geometry.hpp"

namespace gambeson {
namespace {

/// A panel with a curved side, a slanted one and a grain that leans, and a rectangle; sewn along parts of their edges.
FlatPattern twoPanels() {
  FlatPattern p;
  Panel a;
  a.name = "front";
  a.outline = {{"hem", {0, 0}, StraightEdge{}},
               {"side", {0.3, 0}, BezierEdge{{{0.42, 0.2}}}},
               {"top", {0.25, 0.4}, StraightEdge{}},
               {"back edge", {0.02, 0.37}, ArcEdge{0.6}}};
  a.grain = GrainLine{{0.1, 0.1}, {0.15, 0.3}};
  a.placement = PanelPlace{{0.25, -0.1, 0.9}};
  Panel b;
  b.name = "back";
  b.outline = {{"", {-0.2, 0}, StraightEdge{}},
               {"", {0.2, 0}, StraightEdge{}},
               {"", {0.2, 0.5}, StraightEdge{}},
               {"", {-0.2, 0.5}, StraightEdge{}}};
  b.placement = PanelPlace{{-0.25, 0, 0.9}, {0, -1, 0}, {0, 0, 1}};
  p.panels = {a, b};
  p.seams = {{"side", {{0, 1, 0, 1}}, {{1, 3, 1, 0}}}, {"", {{0, 3, 0.25, 1}}, {{1, 1, 0.5, 0}}}};
  checkPattern(p);
  return p;
}

std::string refusal(const FlatPattern& p, std::string* key = nullptr) {
  try {
    panelGarment(p, {});
  } catch (const InputError& e) {
    if (key) *key = e.where().key;
    return e.reason();
  }
  return "";
}

TEST(PanelGarment, HasTheAreasAndLengthsOfThePattern) {
  const FlatPattern p = twoPanels();
  const Garment g = panelGarment(p, {0.02, 2});
  double area = 0, wanted = 0;
  for (const double a : controlAreas(g)) area += a;
  for (const Panel& panel : p.panels) wanted += areaOf(panel);
  EXPECT_NEAR(area, wanted, 1e-7 * wanted);
  ASSERT_EQ(g.sewn_seams.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(lengthOf(g, g.sewn_seams[k].a), lengthOf(p, p.seams[k].a), 1e-9);
    EXPECT_NEAR(lengthOf(g, g.sewn_seams[k].b), lengthOf(p, p.seams[k].b), 1e-9);
  }
  EXPECT_EQ(g.patch_names, (std::vector<std::string>{"front", "back"}));
}

TEST(PanelGarment, StandsWhereItIsPlacedOnItsGrain) {
  const FlatPattern p = twoPanels();
  const Garment g = panelGarment(p, {0.02, 2});
  for (std::size_t k = 0; k < 2; ++k) {
    const NurbsPatch& patch = g.patches[k];
    const auto d =
        surfaceDerivatives(patch, 0.5 * (patch.u.front() + patch.u.back()), 0.5 * (patch.v.front() + patch.v.back()));
    EXPECT_NEAR(norm(d[1]), 1, 1e-12);
    EXPECT_NEAR(norm(d[2]), 1, 1e-12);
    const PanelPlace& place = *p.panels[k].placement;
    EXPECT_LT(norm(cross(d[1], d[2]) - cross(place.along_x, place.along_y)), 1e-12) << "the right side looks out";
    EXPECT_LT(norm(normalized(g.weft[k]) - d[1]), 1e-12);
    // Corners of the outline, through the loop of the trim.
    for (std::size_t e = 0; e < p.panels[k].outline.size(); ++e) {
      const Vec2 at = p.panels[k].outline[e].start_m;
      const NurbsCurve& c = g.trims[k].loops[0][e];
      const Vec2 uv = curvePoint(c, c.knots.front()).point;
      const Vec3 x = surfaceDerivatives(patch, uv.x, uv.y)[0];
      EXPECT_LT(norm(x - (place.origin_m + at.x * place.along_x + at.y * place.along_y)), 1e-12);
    }
  }
  const Vec3 warp = normalized(Vec3{0, 0.05, 0.2});
  const auto d = surfaceDerivatives(g.patches[0], g.patches[0].u.front(), g.patches[0].v.front());
  EXPECT_LT(norm(d[2] - warp), 1e-12);
}

/// A panel may be called what the second piece of another one would be.
TEST(PanelGarment, PiecesAreCalledLikeNoOtherPanel) {
  FlatPattern p = twoPanels();
  p.seams.clear();
  Panel darted;
  darted.name = "front";
  for (const Vec2 c : {Vec2{0, 0}, {0.2, -0.03}, {0.2, -0.2}, {-0.2, -0.2}, {-0.2, 0.2}, {0.2, 0.2}, {0.2, 0.03}})
    darted.outline.insert(darted.outline.begin(), PanelEdge{"", c, StraightEdge{}});
  darted.placement = PanelPlace{};
  p.panels = {darted, p.panels[1], p.panels[1]};
  p.panels[1].name = "front 2", p.panels[2].name = "back";
  p.seams = {{"dart", {{0, 5, 0, 1}}, {{0, 6, 1, 0}}, SeamUse::dart}};
  std::swap(p.seams[0].a[0].from, p.seams[0].a[0].to), std::swap(p.seams[0].b[0].from, p.seams[0].b[0].to);
  const auto names = [&] { return panelGarment(p, {0.02, 2}).patch_names; };
  EXPECT_EQ(names(), (std::vector<std::string>{"front", "front piece 2", "front 2", "back"}));
  p.panels[1].name = "side";
  EXPECT_EQ(names(), (std::vector<std::string>{"front", "front 2", "side", "back"}));
}

TEST(PanelGarment, WhatIsWrongIsNamed) {
  std::string key;
  FlatPattern p = twoPanels();
  p.panels[1].placement.reset();
  EXPECT_NE(refusal(p, &key).find("\"back\" has no placement"), std::string::npos);
  EXPECT_EQ(key, "panels[1]");
  p = twoPanels();
  p.panels[0].quantity = 2;
  EXPECT_NE(refusal(p, &key).find("\"front\" is cut 2 times"), std::string::npos);
  p = twoPanels();
  p.seams[0].b[0].to = 0.8;  // 10 cm against 42
  const std::string ratio = refusal(p, &key);
  EXPECT_NE(ratio.find("2:1"), std::string::npos) << ratio;
  EXPECT_NE(ratio.find("side: front.1 to back.3"), std::string::npos) << ratio;
  EXPECT_EQ(key, "seams[0]");
}

}  // namespace
}  // namespace gambeson
