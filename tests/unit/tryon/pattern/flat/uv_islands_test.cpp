/// Islands of uv: a cone that is a sector when it lies flat, sewn to itself; a disc sewn into a ring all around.

#include "tryon/pattern/flat/uv_islands.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tryon/pattern/flat/panel_geometry.hpp"
#include "tryon/pattern/weld_mesh.hpp"

namespace gambeson {
namespace {

constexpr int kConeSides = 12;

/// A cone of twelve triangles whose slant is 0.5 m, over a circle of 0.3 m; uv: its sector, in units of 0.25 m.
ClothMesh uvCone() {
  ClothMesh m;
  m.patch_names = {"cone"};
  m.vertices.push_back({0, 0, 0.4});
  const double side = 2 * 0.3 * std::sin(std::numbers::pi / kConeSides), step = 2 * std::asin(side / 2 / 0.5);
  for (int i = 0; i < kConeSides; ++i) {
    const double a = 2 * std::numbers::pi * i / kConeSides;
    m.vertices.push_back({0.3 * std::cos(a), 0.3 * std::sin(a), 0});
    m.triangles.push_back({0, 1 + i, 1 + (i + 1) % kConeSides});
    m.patch.push_back(0);
    const auto at = [&](int k) { return Vec2{2 * std::cos(k * step), 2 * std::sin(k * step)}; };
    m.uv.push_back({Vec2{0, 0}, at(i), at(i + 1)});
  }
  return m;
}

TEST(UvIslands, AConeIsASectorSewnToItself) {
  const ClothMesh m = uvCone();
  const UvFit fit = fitUv(m);
  EXPECT_EQ(fit.fault, "");
  EXPECT_NEAR(fit.scale_m, 0.25, 1e-15);
  EXPECT_LT(fit.rms, 1e-14);
  int mirrored = 0;
  const ClothMesh islands = islandsOf(m, fit.scale_m, mirrored);
  EXPECT_EQ(mirrored, 0);
  const FlatPattern flat = flatOfIslands(islands, "cone");
  ASSERT_EQ(flat.panels.size(), 1u);
  EXPECT_NEAR(areaOf(flat.panels[0]), areaOf(m, 0), 1e-14);
  ASSERT_EQ(flat.seams.size(), 1u);
  EXPECT_EQ(flat.seams[0].use, SeamUse::dart);
  EXPECT_NEAR(lengthOf(flat, flat.seams[0].a), 0.5, 1e-14);
  EXPECT_NEAR(lengthOf(flat, flat.seams[0].b), 0.5, 1e-14);
}

TEST(UvIslands, ADiscIsSewnIntoARingAllAround) {
  ClothMesh m;
  m.patch_names = {"disc", "ring"};
  m.vertices.push_back({0, 0, 0});
  for (const double r : {0.1, 0.2})
    for (int i = 0; i < kConeSides; ++i) {
      const double a = 2 * std::numbers::pi * i / kConeSides;
      m.vertices.push_back({r * std::cos(a), r * std::sin(a), 0});
    }
  const auto add = [&](int patch, std::array<int, 3> t, double shift) {
    m.triangles.push_back(t);
    m.patch.push_back(patch);
    auto& uv = m.uv.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 x = m.vertices[static_cast<std::size_t>(t[k])];
      uv[k] = {x.x + shift, x.y};
    }
  };
  for (int i = 0; i < kConeSides; ++i) add(0, {0, 1 + i, 1 + (i + 1) % kConeSides}, 0);
  for (int i = 0; i < kConeSides; ++i) {
    const int a = 1 + i, b = 1 + (i + 1) % kConeSides;
    add(1, {a, a + kConeSides, b + kConeSides}, 1);
    add(1, {a, b + kConeSides, b}, 1);
  }
  EXPECT_EQ(weldMesh(m, 1e-5).turned, 0);
  const FlatPattern flat = flatOfIslands(m, "disc");
  ASSERT_EQ(flat.panels.size(), 2u);
  EXPECT_EQ(flat.panels[0].outline.size(), 1u);
  EXPECT_EQ(flat.panels[1].cutouts.size(), 1u);
  ASSERT_EQ(flat.seams.size(), 1u);
  const double around = kConeSides * 2 * 0.1 * std::sin(std::numbers::pi / kConeSides);
  EXPECT_NEAR(lengthOf(flat, flat.seams[0].a), around, 1e-14);
  EXPECT_NEAR(lengthOf(flat, flat.seams[0].b), around, 1e-14);
  EXPECT_NEAR(areaOf(flat.panels[1]), areaOf(m, 1), 1e-14);
}

/// A border of one name that runs over two islands of a patch is in both, part by part.
TEST(UvIslands, NamedEdgesCrossFromIslandToIsland) {
  ClothMesh m;
  m.patch_names = {"front"};
  for (int i = 0; i < 5; ++i)
    for (const double y : {0.0, 1.0}) m.vertices.push_back({i * 1.0, y, 0});
  for (int i = 0; i < 4; ++i)
    for (const std::array<int, 3>& t :
         {std::array{2 * i, 2 * i + 2, 2 * i + 3}, std::array{2 * i, 2 * i + 3, 2 * i + 1}}) {
      m.triangles.push_back(t);
      m.patch.push_back(0);
      auto& uv = m.uv.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& x = m.vertices[static_cast<std::size_t>(t[k])];
        uv[k] = {x.x + (i < 2 ? 0 : 7), x.y};  // cut in the middle
      }
    }
  m.lines = {{"hem", 0, {0, 2, 4, 6, 8}}, {"end", 0, {8, 9}}};
  int mirrored = 0;
  const ClothMesh islands = islandsOf(m, 1, mirrored);
  ASSERT_EQ(islands.patch_names.size(), 2u);
  ASSERT_EQ(islands.lines.size(), 3u);
  EXPECT_EQ(islands.lines[0].name, "hem");
  EXPECT_EQ(islands.lines[0].patch, 0);
  EXPECT_EQ(islands.lines[0].vertices, (std::vector<int>{0, 2, 4}));
  EXPECT_EQ(islands.lines[1].name, "hem");
  EXPECT_EQ(islands.lines[1].patch, 1);
  EXPECT_EQ(islands.lines[1].vertices, (std::vector<int>{4, 6, 8}));
  EXPECT_EQ(islands.lines[2].patch, 1);
}

TEST(UvIslands, UvThatIsNoShapeIsSaid) {
  ClothMesh folded = uvCone();
  folded.uv[2][2] = folded.uv[3][1] = folded.uv[4][2];  // beyond the far side of the next
  EXPECT_NE(fitUv(folded).fault, "");
  ClothMesh empty = uvCone();
  empty.uv[3] = {Vec2{1, 1}, Vec2{1, 1}, Vec2{1, 1}};
  EXPECT_NE(fitUv(empty).fault, "");
}

}  // namespace
}  // namespace gambeson
