/// The skin on the reference device: what core's skinPositions says, bit for bit, at each time of a window.
#include "gpu/near/skin_bender.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "gpu/scenes/skins.hpp"

namespace gambeson::gpu {
namespace {

TEST(SkinBender, BendsAsCoreDoesToTheLastBit) {
  constexpr int kTimes = 7;
  for (const Skin& skin : {tubeSkin(24, 90), blendedTube(24, 40)}) {
    const std::vector<Pose> poses = tubePoses(skin, kTimes);
    const auto bender = skinOnReference(skin, kTimes);
    bender->bend(poses, kTimes);
    const std::size_t links = skin.bind.size();
    double most = 0;
    for (int k = 0; k < kTimes; ++k) {
      std::vector<Vec3> truth(skin.rest.vertices.size());
      skinPositions(skin, std::span(poses).subspan(static_cast<std::size_t>(k) * links, links), truth);
      EXPECT_EQ(bender->positions(k), truth) << "time " << k << ", bends " << skin.bends.size();
      for (std::size_t v = 0; v < truth.size(); ++v) most = std::max(most, norm(truth[v] - skin.rest.vertices[v]));
    }
    EXPECT_GT(most, 0.3);
  }
}

/// Creases move vertices: without them the same skin comes elsewhere.
TEST(SkinBender, KeepsTheSidesOfAFoldApart) {
  const Skin skin = tubeSkin(24, 90);
  Skin flat = skin;
  flat.creases.clear();
  const std::vector<Pose> poses = tubePoses(skin, 3);
  const auto folded = skinOnReference(skin, 3), through = skinOnReference(flat, 3);
  folded->bend(poses, 3);
  through->bend(poses, 3);
  EXPECT_EQ(folded->positions(0), through->positions(0));
  int moved = 0;
  const std::vector<Vec3> a = folded->positions(2), b = through->positions(2);
  for (std::size_t v = 0; v < a.size(); ++v) moved += a[v] != b[v];
  EXPECT_GT(moved, 50);
}

TEST(SkinBender, SaysWhatDoesNotFit) {
  const Skin skin = tubeSkin(8, 12);
  const auto bender = skinOnReference(skin, 2);
  EXPECT_THROW(bender->bend(tubePoses(skin, 3), 3), RunError);
  EXPECT_THROW(bender->bend(tubePoses(skin, 2), 1), RunError);
}

}  // namespace
}  // namespace gambeson::gpu
