/// The skin in motion: it does not cross itself, folds keep their gap, limbs keep clear.

#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "exact/intersections.hpp"
#include "human/body/skin.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/walk.hpp"
#include "human/skin/make_skin.hpp"
#include "unit/human/skin/postures.hpp"

namespace gambeson {
namespace {

const Human& human() {
  static const Human h = makeManikin("male_p50");
  return h;
}
const Skin& skin() {
  static const Skin s = makeSkin(human());
  return s;
}

TEST(SkinFolds, DoesNotTouchItselfAtRest) {
  EXPECT_TRUE(exact::intersections(skin().rest.vertices, skin().rest.triangles).none());
}

TEST(SkinFolds, FoldsWithoutCrossingAndKeepsTheGap) {
  const auto check = [](const Angles& angles, const std::string& what) {
    const std::vector<Vec3> x = posed(human(), skin(), angles);
    EXPECT_EQ(crossings(skin(), x), 0u) << what;
    EXPECT_GE(narrowest(skin(), x), skin().crease_gap_m) << what;
  };
  check(stairs, "stairs");
  check(folded, "knees and elbows");
  for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0})
    check(between(low_ready, aiming, u), "aiming " + std::to_string(u));
  for (const double hip : {30.0, 60.0, 95.0}) check({{"hip_flexion_left", hip}}, "hip " + std::to_string(hip));
}

TEST(SkinFolds, TheGapIsWhatIsAskedFor) {
  const Skin wide = makeSkin(human(), {.cell_m = 0.018, .crease_gap_m = 0.008});
  EXPECT_GE(narrowest(wide, posed(human(), wide, folded)), 0.008);
  const Skin narrow = makeSkin(human(), {.cell_m = 0.018, .crease_gap_m = 0.001});
  EXPECT_LT(narrowest(narrow, posed(human(), narrow, folded)), 0.008);
}

/// Inner thighs: two thicknesses of the shorts, 0.762 mm each (Zheng 2013, 6.2), and 3 mm. Arms: 20 mm from a shirt 5
/// mm off the trunk, below the armholes (a hand's breadth, 0.1 m, below the armpits) and for forearms and hands.
TEST(SkinFolds, WalkingKeepsThighsApartAndArmsOffTheShirt) {
  const auto walk = makeWalk(human(), {});
  const Skin& s = skin();
  std::vector<Vec3> x(s.rest.vertices.size());
  const auto side = [&](int v) {
    const std::string& name = human().skeleton.links[s.segment[v]].name;
    return name.starts_with("thigh") ? (name.ends_with("left") ? 1 : -1) : 0;
  };
  std::vector<char> free_arm(x.size()), covered(x.size());
  const int shoulder = human().skeleton.link("upper_arm_left");
  const double armpit = s.bind[shoulder].origin.z - 0.12, low = s.bind[0].origin.z - 0.2;  // the shirt ends above `low`
  for (std::size_t v = 0; v < x.size(); ++v) {
    const std::string& name = human().skeleton.links[s.segment[v]].name;
    const double z = s.rest.vertices[v].z;
    const bool arm = name.find("arm") != std::string::npos || name.starts_with("hand");
    free_arm[v] = arm && z < armpit - 0.1;
    covered[v] = !arm && z > low && z < armpit + 0.1;
  }
  for (int i = 0; i <= 8; ++i) {
    const Posture p = walk->at(0.5 + 1.1 * i / 8);
    skinPositions(s, linkPoses(human().skeleton, p.q, p.root), x);
    EXPECT_EQ(crossings(s, x), 0u) << i;
    EXPECT_GT(narrowest(s, x, [&](int v, int w) { return side(v) * side(w) < 0; }), 2 * 0.762e-3 + 3e-3) << i;
    double clear = 1;
    for (std::size_t v = 0; v < x.size(); ++v)
      if (free_arm[v])
        for (std::size_t w = 0; w < x.size(); ++w)
          if (covered[w]) clear = std::min(clear, norm(x[w] - x[v]));
    EXPECT_GT(clear, 0.025) << i;
  }
}

TEST(SkinFolds, IsTheSameForAnyNumberOfThreads) {
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  const std::vector<Vec3> one = posed(human(), skin(), aiming);
  omp_set_num_threads(3);
  const std::vector<Vec3> three = posed(human(), skin(), aiming);
  const Skin again = makeSkin(human());
  omp_set_num_threads(threads);
  EXPECT_EQ(one, three);
  EXPECT_EQ(again.rest.vertices, skin().rest.vertices);
  EXPECT_EQ(again.weight, skin().weight);
}

/// Velocity is continuous: from one step to the next it changes by an amount that falls with the step. Under a clamp
/// with a kink the vertex that is just being caught would jump by the same at any step.
TEST(SkinFolds, MovesWithContinuousVelocity) {
  const auto largestJump = [&](int steps) {
    std::vector<std::vector<Vec3>> x;
    double largest = 0;
    for (int i = 0; i <= steps; ++i) {
      x.push_back(posed(human(), skin(), between({}, folded, 0.05 + 0.25 * i / steps)));
      if (i < 2) continue;
      for (std::size_t v = 0; v < x[i].size(); ++v)
        largest = std::max(largest, norm(x[i][v] - 2 * x[i - 1][v] + x[i - 2][v]) * steps);
    }
    return largest;
  };
  EXPECT_LT(largestJump(200), 0.4 * largestJump(50));  // 0.25 where the acceleration is bounded
}

/// Where one link has all the weight the skin is rigid with it, whatever the joint does (creases aside).
TEST(SkinFolds, IsRigidAwayFromTheJoints) {
  Posture p = standing(human());
  p.q.at(human().skeleton.joint("hip_flexion_left")) = 1.2;
  p.q.at(human().skeleton.joint("knee_flexion_left")) = 0.9;
  const auto X = linkPoses(human().skeleton, p.q, p.root);
  std::vector<Vec3> x(skin().rest.vertices.size());
  skinPositions(skin(), X, x);
  const int shank = human().skeleton.link("shank_left"), foot = human().skeleton.link("foot_left");
  int count = 0;
  for (std::size_t v = 0; v < x.size(); ++v) {
    const int l = skin().segment[v];
    if ((l != shank && l != foot) || skin().first[v + 1] - skin().first[v] > 1) continue;
    const Vec3 rigid = X[l] * (inverse(skin().bind[l]) * skin().rest.vertices[v]);
    if (l == foot || norm(rigid - X[shank].origin) > 0.2) {
      EXPECT_LT(norm(x[v] - rigid), 1e-12);
      ++count;
    }
  }
  EXPECT_GT(count, 300);
}

}  // namespace
}  // namespace gambeson
