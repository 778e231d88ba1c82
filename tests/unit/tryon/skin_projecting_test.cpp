/// Virtual projecting of a skin: free of the garment, no smaller than need be, and what touches nothing stays.

#include "tryon/skin_projecting.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/contact/proximity.hpp"
#include "core/error.hpp"
#include "human/body/skin.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "human/skin/make_skin.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace {

class ProjectedSkin : public testing::Test {
 protected:
  Human human = [] {
    Human h = makeManikin("male_p50");
    h.skin = std::make_shared<const Skin>(makeSkin(h, {0.025, 0.003}));
    return h;
  }();
  std::vector<Pose> poses = [this] {
    const Posture p = standing(human);
    return linkPoses(human.skeleton, p.q, p.root);
  }();
  std::vector<Obstacle> obstacles = obstaclesOf(human);
  ProximityQuery query{obstacles};

  double nearest(const std::vector<Vec3>& skin, const std::vector<Vec3>& samples) const {
    DeformedSurfaces surfaces(obstacles);
    surfaces.move({skin});
    double least = 1;
    for (const Vec3& x : samples) least = std::min(least, query.signedDistance(0, {}, x, &surfaces));
    return least;
  }
};

TEST_F(ProjectedSkin, IsFreeOfTheShortsAndStaysElsewhere) {
  constexpr double clearance = 0.005;
  ShortsPattern pattern;
  pattern.ease = 0.0;
  std::vector<Vec3> samples;
  for (const NurbsPatch& p : makeShorts(pattern, human).patches)
    for (int j = 0; j <= 16; ++j)
      for (int i = 0; i <= 24; ++i) samples.push_back(surfaceDerivatives(p, i / 24.0, j / 16.0)[0]);
  std::vector<Vec3> skin(human.skin->rest.vertices.size());
  skinPositions(*human.skin, poses, skin);
  ASSERT_LT(nearest(skin, samples), clearance);

  const ShrunkSkin shrunk = shrinkSkinToFree(human, poses, samples, clearance);
  EXPECT_GE(nearest(shrunk.x, samples), clearance);
  const auto factor = [&](const char* name) {
    return shrunk.factor[static_cast<std::size_t>(human.skeleton.link(name))];
  };
  EXPECT_LT(factor("thigh_left"), 1);
  EXPECT_GT(factor("thigh_left"), 0.6);
  EXPECT_EQ(factor("shank_left"), 1);
  EXPECT_EQ(factor("head"), 1);
  double farthest = 0;
  int moved = 0;
  for (std::size_t v = 0; v < skin.size(); ++v) {
    const double way = norm(shrunk.x[v] - skin[v]);
    farthest = std::max(farthest, way);
    moved += way > 0;
    bool of_shrunk = false;
    for (int i = human.skin->first[v]; i < human.skin->first[v + 1]; ++i)
      of_shrunk =
          of_shrunk || shrunk.factor[static_cast<std::size_t>(human.skin->link[static_cast<std::size_t>(i)])] < 1;
    if (!of_shrunk) {
      EXPECT_EQ(way, 0);
    }
  }
  EXPECT_GT(moved, 100);
  EXPECT_LT(farthest, 0.08);
  // A smooth field: no edge is stretched or turned over much.
  for (const auto& t : human.skin->rest.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
      EXPECT_LT(norm((shrunk.x[a] - skin[a]) - (shrunk.x[b] - skin[b])), 0.8 * norm(skin[a] - skin[b]));
    }
}

TEST_F(ProjectedSkin, SaysWhatCannotBeFreed) {
  const auto l = static_cast<std::size_t>(human.skeleton.link("thigh_right"));
  const std::vector<Vec3> samples{
      0.5 * (poses[l].origin + poses[static_cast<std::size_t>(human.skeleton.link("shank_right"))].origin)};
  try {
    shrinkSkinToFree(human, poses, samples, 0.005);
    FAIL() << "a sample at the bone";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("thigh_right"), std::string::npos) << e.what();
  }
  EXPECT_THROW(shrinkSkinToFree(human, poses, samples, 0), InputError);
  EXPECT_THROW(shrinkSkinToFree(human, poses, samples, std::nan("")), InputError);
}

}  // namespace
}  // namespace gambeson
