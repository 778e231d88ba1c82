/// Skins that fold into themselves, and the surface that bridges these folds. A skin of ours is blended linearly here,
/// as those from files are, which lets its knees and elbows pass through themselves.

#include "human/skin/bridge_folds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "exact/intersections.hpp"
#include "human/body/skin.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/blend.hpp"
#include "human/motion/standing.hpp"
#include "human/skin/make_skin.hpp"
#include "human/skin/overlap.hpp"
#include "unit/human/skin/postures.hpp"

namespace gambeson {
namespace {

constexpr double kRoom_m = 0.003;

struct Bent {
  Human human = makeManikin("male_p50");
  Posture straight, bent;
  BridgedFolds folds;
  BridgingReport report;

  Bent() {
    Skin skin = makeSkin(human, {.cell_m = 0.014});
    skin.bends.clear(), skin.runs.clear(), skin.creases.clear();
    human.skin = std::make_shared<const Skin>(std::move(skin));
    straight = bent = standing(human);
    for (const char* knee : {"knee_flexion_left", "knee_flexion_right"})
      bent.q.at(human.skeleton.joint(knee)) = 120 * rad_per_deg;
    folds = bridgeFolds(
        human, [&](double t) { return at(t); }, 0, 0.6, 0.02, kRoom_m, report);
  }
  Posture at(double t) const {
    const double u = std::clamp(t / 0.6, 0.0, 1.0);
    return blend(straight, bent, u * u * (3 - 2 * u));
  }
  std::vector<Vec3> skinAt(double t, bool bridged) const {
    const Posture p = at(t);
    const std::vector<Pose> poses = linkPoses(human.skeleton, p.q, p.root);
    std::vector<Vec3> x(human.skin->rest.vertices.size());
    skinPositions(*human.skin, poses, x);
    if (bridged) bridge(folds, *human.skin, poses, t, x);
    return x;
  }
};

const Bent& bent() {
  static const Bent b;
  return b;
}

/// At instants that it was made of and between them. Nearly everywhere it has its room; the rest is the rim's.
TEST(BridgedFolds, DoNotPassThroughThemselves) {
  const auto& triangles = bent().human.skin->rest.triangles;
  EXPECT_GT(overlapOf(triangles, bent().skinAt(0.6, false)).area_m2, 20e-4);
  EXPECT_GT(bent().report.largest_m2, 50e-4);
  EXPECT_LT(bent().report.left_m2, 0.05 * bent().report.largest_m2);
  for (const double t : {0.0, 0.2, 0.29, 0.3, 0.35, 0.41, 0.47, 0.5, 0.55, 0.59, 0.6}) {
    const std::vector<Vec3> x = bent().skinAt(t, true);
    EXPECT_TRUE(exact::intersections(x, triangles).none()) << t;
    EXPECT_LT(overlapOf(triangles, x, kRoom_m / 2).area_m2, 1e-4) << t;
  }
}

/// Standing, where nothing is tight, no vertex is moved; and none is moved far from where it folds.
TEST(BridgedFolds, LeaveTheRestAsItIs) {
  EXPECT_EQ(bent().skinAt(0, true), bent().skinAt(0, false));
  const std::vector<Vec3> with = bent().skinAt(0.6, true), without = bent().skinAt(0.6, false);
  const Skeleton& skeleton = bent().human.skeleton;
  const Posture p = bent().at(0.6);
  const std::vector<Pose> poses = linkPoses(skeleton, p.q, p.root);
  std::size_t moved = 0;
  for (std::size_t v = 0; v < with.size(); ++v) {
    if (with[v] == without[v]) continue;
    ++moved;
    double near = 1;
    for (const char* shank : {"shank_left", "shank_right"})
      near = std::min(near, norm(with[v] - poses[static_cast<std::size_t>(skeleton.link(shank))].origin));
    EXPECT_LT(near, 0.25);
  }
  EXPECT_GT(moved, 20u);
  EXPECT_LT(moved, with.size() / 5);
  EXPECT_LT(bent().report.farthest_m, 0.06);
}

/// Its velocity is continuous: it changes within a step by what falls with the step.
TEST(BridgedFolds, MoveWithContinuousVelocity) {
  const auto largestChange = [&](double dt) {
    double largest = 0;
    std::vector<Vec3> before = bent().skinAt(0.3, true), now = bent().skinAt(0.3 + dt, true);
    for (double t = 0.3 + 2 * dt; t < 0.5; t += dt) {
      const std::vector<Vec3> next = bent().skinAt(t, true);
      for (std::size_t v = 0; v < next.size(); ++v)
        largest = std::max(largest, norm(next[v] - 2 * now[v] + before[v]) / dt);
      before = std::move(now), now = next;
    }
    return largest;
  };
  EXPECT_LT(largestChange(0.5e-3), 0.4 * largestChange(4e-3));
}

/// Of two parts of one mesh that do not hang together, one within the other: that one, whole.
TEST(BridgedFolds, HaveNoRimWhereAWholePartLiesWithin) {
  const TriangleMesh mesh{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {.1, .1, .1}, {.2, .1, .1}, {.1, .2, .1}, {.1, .1, .2}},
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {4, 6, 5}, {4, 5, 7}, {5, 6, 7}, {4, 7, 6}}};
  EXPECT_EQ(wholeParts(mesh, {1, 1, 1, 0, 1, 1, 1, 1}), (std::vector<char>{0, 0, 0, 0, 1, 1, 1, 1}));
}

}  // namespace
}  // namespace gambeson
