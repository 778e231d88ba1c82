/// Trousers that step over an obstacle: the scene of the library's case (Man 2006, 5.4).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/wear/scene/supports.hpp"
#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

const std::vector<std::string> coarse{R"(garment.trousers.cell="60 mm")"};

// Figure 47: they start below the feet, which are left out, and the waist edge goes up to where it is worn.
TEST(TrousersScene, ArePulledUpOverTheLegs) {
  const auto s = buildScenario(libraryCase("trousers_step_over", coarse));
  const Model& m = *s->model;
  StepWork work;
  const State state = startOf(*s, work);
  std::vector<Vec3> x;
  samplePositions(m, state.p, x);
  const std::vector<Placement> bodies = s->obstaclePlacements(s->start_s);
  double lowest = 1, highest = -10;
  for (std::size_t o = 0; o < s->human->shapes.size(); ++o) {
    const Vec3 low = lowestPoint(m.obstacles[o].shape, bodies[o].rotation);
    lowest = std::min(lowest, (bodies[o] * low).z);
    EXPECT_EQ(s->stage->leavesOut(static_cast<int>(o), 0), s->human->shapes[o].name.starts_with("foot"));
    EXPECT_FALSE(s->stage->leavesOut(static_cast<int>(o), 2));
  }
  for (const Vec3& p : x) highest = std::max(highest, p.z);
  EXPECT_LT(highest, lowest - 0.01);
  // The waist edge is held where the draft opens it, not where it is at rest, front on back.
  for (const int i : s->supports[1].samples)
    if (std::abs(x[static_cast<std::size_t>(i)].y) < 0.01) {
      EXPECT_GT(std::abs(x[static_cast<std::size_t>(i)].x), 0.12);
    }
  const HeldSupport& hands = *heldOf(s->definition.supports[0]);
  EXPECT_NEAR(hands.drive.at(*hands.release_s).origin.z, -s->definition.garments[0].position_m.z, 1e-12);
  EXPECT_LT(*hands.release_s, std::get<StepOverOptions>(s->definition.human->motion).stand_s);
}

// The obstacle is a box where the motion has it, and no foot comes nearer to it than A21 asks.
TEST(TrousersScene, TheObstacleStandsWhereTheFeetPass) {
  const auto s = buildScenario(libraryCase("trousers_step_over", coarse));
  const auto& box = std::get<TriangleMesh>(s->model->obstacles.back().shape);
  const std::vector<Placement> at = s->obstaclePlacements(0);
  Vec3 low = at.back() * box.vertices[0], high = low;
  double volume = 0;
  for (const auto& t : box.triangles) {
    const Vec3 a = box.vertices[t[0]], b = box.vertices[t[1]], c = box.vertices[t[2]];
    volume += dot(a, cross(b, c)) / 6;
  }
  for (const Vec3& v : box.vertices)
    for (int k = 0; k < 3; ++k)
      low[k] = std::min(low[k], (at.back() * v)[k]), high[k] = std::max(high[k], (at.back() * v)[k]);
  EXPECT_NEAR(volume, 0.05 * 1.6 * 0.5, 1e-12);  // closed, and seen from outside
  EXPECT_EQ(low.z, 0);
  EXPECT_NEAR(high.z, 0.5, 1e-15);
  EXPECT_NEAR(high.y, 0.8, 1e-15);
  const Hurdle hurdle{low.x, high.x - low.x, high.z};
  double gap = 1;
  for (int i = 0; i <= 500; ++i) {
    const Posture p = s->motion->at(s->motion->duration() * i / 500);
    const auto X = linkPoses(s->human->skeleton, p.q, p.root);
    for (const char* side : {"right", "left"}) {
      const BodyShape& foot = footOf(*s->human, side, "");
      gap = std::min(gap, gapToHurdle(foot.shape, X[foot.link] * foot.X_LS, hurdle));
    }
  }
  EXPECT_GE(gap, 0.020);
  EXPECT_LT(gap, 0.060);
}

TEST(TrousersScene, AnObstacleNeedsWhoStepsOverIt) {
  const auto refused = [](std::vector<std::string> set) -> std::string {
    set.push_back(coarse[0]);
    try {
      buildScenario(libraryCase("trousers_step_over", set));
    } catch (const InputError& e) {
      return e.where().key;
    }
    return "accepted";
  };
  EXPECT_EQ(refused({R"(human.motion={"stand": {"duration": "4 s"}})"}), "obstacles[0].hurdle");
  EXPECT_EQ(refused({"human.motion.step_over.depth=0"}), "obstacles[0].hurdle");
  EXPECT_EQ(refused({R"(garment.trousers.hem="0.9 m")"}), "garment.trousers.hem");
  EXPECT_EQ(refused({"obstacles=[]"}), "accepted");
}

}  // namespace
}  // namespace gambeson
