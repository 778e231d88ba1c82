/// Regions of a garment: where their factors lie, and what is wrong with them.

#include "cases/cloth/regions.hpp"

#include <gtest/gtest.h>

#include "core/cloth/draft/fields.hpp"
#include "core/error.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace {

/// Two patches of a unit square.
Garment twoSquares() {
  Garment g = makeSheet({.width_m = 1, .height_m = 1, .cells_u = 4, .cells_v = 4});
  g.patches.push_back(g.patches[0]);
  g.weft.push_back(g.weft[0]);
  g.patch_names = {"left", "right"};
  g.fabric.thickness_m = 1e-3;
  g.fabric.density_kg_per_m3 = 500;
  g.fabric.law = LinearBending{};
  return g;
}

TEST(Regions, FactorsLieWhereTheirPartsAre) {
  Garment g = twoSquares();
  applyRegions({{"low", {{"left", {0, 1}, {0, 0.25}}, {"right", {0.5, 1}, {0.25, 0.5}}}, 2},
                {"high", {{"left", {0, 1}, {0.6, 1}}}, 0.5}},
               g);
  const auto factor = [&](int patch, Vec2 uv) { return surfaceDensityAt(g, patch, uv) / 0.5; };
  EXPECT_DOUBLE_EQ(factor(0, {0.1, 0.2}), 2);
  EXPECT_DOUBLE_EQ(factor(0, {0.1, 0.3}), 1);  // between regions
  EXPECT_DOUBLE_EQ(factor(0, {0.9, 0.59}), 1);
  EXPECT_DOUBLE_EQ(factor(0, {0.9, 0.61}), 0.5);
  EXPECT_DOUBLE_EQ(factor(1, {0.51, 0.49}), 2);  // of 2 x 4 cells one, and none that lies the other way round
  EXPECT_DOUBLE_EQ(factor(1, {0.99, 0.26}), 2);
  for (const Vec2 beside : {Vec2{0.49, 0.4}, Vec2{0.6, 0.24}, Vec2{0.6, 0.51}, Vec2{0.4, 0.9}, Vec2{0.9, 0.7}})
    EXPECT_DOUBLE_EQ(factor(1, beside), 1);
}

TEST(Regions, WithoutPartsTheyAreTheWholeGarment) {
  Garment g = twoSquares();
  applyRegions({{"all", {}, 1.5}}, g);
  EXPECT_DOUBLE_EQ(surfaceDensityAt(g, 0, {0.3, 0.3}), 0.75);
  EXPECT_DOUBLE_EQ(surfaceDensityAt(g, 1, {0.9, 0.9}), 0.75);
}

TEST(Regions, AFactorOfOneIsNoField) {
  Garment g = twoSquares();
  applyRegions({{"all", {}, 1}}, g);
  EXPECT_FALSE(fabricVaries(g, 0));
}

void expectWrong(const std::vector<RegionCase>& regions, Garment g, const std::string& key, const std::string& reason) {
  try {
    applyRegions(regions, g);
    ADD_FAILURE() << "nothing was wrong";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, key);
    EXPECT_NE(e.reason().find(reason), std::string::npos) << e.reason();
  }
}

TEST(Regions, WhatIsWrongIsSaid) {
  expectWrong({{"a", {{"middle"}}, 2}}, twoSquares(), "regions[0].parts[0].patch", "there is no patch \"middle\"");
  expectWrong({{"a", {{"left", {0, 0.5}}}, 2}, {"b", {{"left", {0.4, 1}}}, 2}}, twoSquares(),
              "regions[1].parts[0].patch", "shares cloth of patch left with region \"a\"");
  Garment thick = twoSquares();
  thick.fields.resize(2);
  thick.fields[1].thickness = PatchField{0, 1, 1, {2}};
  expectWrong({{"a", {{"right"}}, 2}}, thick, "regions[0].parts[0].patch", "has a field of its thickness already");
}

}  // namespace
}  // namespace gambeson
