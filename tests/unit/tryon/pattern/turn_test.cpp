// Normals within cells: of a parabola by its slopes; sleeves on a wearer whose armholes are wide for thin arms.
#include "tryon/pattern/turn.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "human/character/character.hpp"
#include "tools/data_folder.hpp"
#include "tryon/pattern/armour.hpp"

namespace gambeson {
namespace {

/// x = u, z = h u^2 over one cell: the slope at u is 2 h u, and looks stand at 0.1 and 0.9 of it.
TEST(Turn, OfAParabolaIsThatOfItsSlopes) {
  for (const double h : {0.01, 1.0, 20.0}) {
    NurbsPatch patch;
    patch.u = {2, {0, 0, 0, 1, 1, 1}};
    patch.v = {1, {0, 0, 1, 1}};
    for (const double y : {0.0, 1.0})
      for (const Vec3& p : {Vec3{0, y, 0}, Vec3{0.5, y, 0}, Vec3{1, y, h}}) patch.points.push_back(p);
    patch.weights.assign(patch.points.size(), 1);
    EXPECT_NEAR(largestTurn(patch), std::atan(1.8 * h) - std::atan(0.2 * h), 1e-12);
  }
}

/// With cells under the arm only twice as wide as others one of the back turned by 105 degrees there (the step of the
/// run was 28 us in place of some 300).
TEST(Turn, OfASleeveLeavesNoCellFolded) {
  const std::filesystem::path folder = test::dataFolder() / "real" / "body";
  if (!std::filesystem::exists(folder / "makehuman_base.obj")) GTEST_SKIP() << "no public bodies at " << folder;
  CharacterOptions body;
  body.file = folder / "makehuman_base.obj";
  body.skeleton = folder / "makehuman_default.mhskel";
  body.weights = folder / "makehuman_default_weights.mhw";
  for (const char* target :
       {"makehuman_caucasian_male_young.target", "makehuman_male_maxmuscle_averageweight.target"}) {
    MorphTarget morph;
    morph.file = folder / target;
    body.targets.push_back(morph);
  }
  const Human human = loadCharacter(body);
  const BodyForm form(human);
  ShirtPattern pattern;
  pattern.cell_m = 0.035;
  pattern.sleeve_ease = 0.15;
  pattern.sleeve_length_m = 0.506;
  const Garment shirt = makeShirt(pattern, form, 0.762e-3, {});
  for (int n = sleeve_front_left; n <= sleeve_under_right; ++n)
    EXPECT_LT(largestTurn(shirt.patches[static_cast<std::size_t>(n)]) * 180 / std::numbers::pi, 95)
        << shirt.patch_names[static_cast<std::size_t>(n)];
}

}  // namespace
}  // namespace gambeson
