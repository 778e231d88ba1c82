// Virtual projecting, Zheng 2013, section 6.3.
#include "tryon/projecting.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "tryon/pattern/pattern.hpp"

namespace gambeson {
namespace {

double nearest(const ProximityQuery& query, int obstacle, const Placement& X, const std::vector<Vec3>& samples) {
  double d = HUGE_VAL;
  for (const Vec3& x : samples) d = std::min(d, query.signedDistance(obstacle, X, x));
  return d;
}

TriangleMesh box(const Vec3& centre, double half) {
  TriangleMesh m;
  for (int k = 0; k < 8; ++k)
    m.vertices.push_back(centre + half * Vec3{k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0});
  m.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                 {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return m;
}

TEST(Projecting, SphereShrinksToTheClosedForm) {
  const std::vector<Obstacle> body{{Ellipsoid{{0.2, 0.2, 0.2}}, "ball"}, {Ellipsoid{{0.1, 0.2, 0.3}}, "far"}};
  const std::vector<Placement> standing{{{}, {1, 2, 3}, 1}, {{}, {9, 9, 9}, 1}};
  const ProximityQuery query(body);
  const std::vector<Vec3> samples{{1.15, 2, 3}, {1, 2, 3.4}};
  const auto shrunk = shrinkToFree(query, body, standing, samples, 0.01);
  EXPECT_NEAR(shrunk[0].scale, (0.15 - 0.01) / 0.2, 1e-4);  // 0.2 k + clearance = distance
  EXPECT_LE(shrunk[0].scale, (0.15 - 0.01) / 0.2);
  EXPECT_EQ(shrunk[0].origin, standing[0].origin);
  EXPECT_EQ(shrunk[1], standing[1]);
}

TEST(Projecting, MeshShrinksAboutItsOwnCentre) {
  // A cube far from its frame's origin, turned and scaled; the sample is above the middle of a face.
  const std::vector<Obstacle> body{{box({0.5, 0.2, -0.3}, 0.1), "box"}};
  const std::vector<Placement> standing{{rotationAbout({0, 0, 1}, 0.7), {1, 2, 3}, 1.5}};
  const ProximityQuery query(body);
  const Vec3 centre = standing[0] * Vec3{0.5, 0.2, -0.3};
  const std::vector<Vec3> samples{centre + Vec3{0, 0, 0.12}};
  const auto shrunk = shrinkToFree(query, body, standing, samples, 0.02);
  EXPECT_NEAR(shrunk[0].scale / 1.5, (0.12 - 0.02) / 0.15, 2e-4);
  EXPECT_LT(norm(shrunk[0] * Vec3{0.5, 0.2, -0.3} - centre), 1e-15);
}

TEST(Projecting, GrowthIsC1AndEndsAtRestWhereItShould) {
  const std::vector<Placement> standing{{rotationAbout({0, 1, 0}, 0.3), {1, 2, 3}, 1}},
      shrunk{{standing[0].rotation, {1.1, 2.2, 2.9}, 0.6}};
  EXPECT_EQ(placementsDuringGrowth(standing, shrunk, 0)[0], shrunk[0]);
  EXPECT_EQ(placementsDuringGrowth(standing, shrunk, 1)[0], standing[0]);
  EXPECT_EQ(placementsDuringGrowth(standing, shrunk, 1.5)[0], standing[0]);
  EXPECT_EQ(placementsDuringGrowth(standing, shrunk, -0.5)[0], shrunk[0]);
  const double h = 1e-5;
  const auto velocity = [&](double t) {
    const Vec3 p{0.1, 0.2, 0.3};
    return (placementsDuringGrowth(standing, shrunk, t + h)[0] * p -
            placementsDuringGrowth(standing, shrunk, t - h)[0] * p) /
           (2 * h);
  };
  for (const double t : {0.0, 1.0}) EXPECT_LT(norm(velocity(t)), 1e-4);
  double before = 0;
  for (int k = 0; k <= 1000; ++k) {
    const double speed = norm(velocity(k / 1000.0));
    EXPECT_LT(std::abs(speed - before), 0.004);  // 6 / 1000 of the way, under half a metre, per step
    before = speed;
    if (k > 0) {
      EXPECT_GE(placementsDuringGrowth(standing, shrunk, k / 1000.0)[0].scale,
                placementsDuringGrowth(standing, shrunk, (k - 1) / 1000.0)[0].scale);
    }
  }
}

class ProjectedShorts : public testing::Test {
 protected:
  Human human = makeManikin("male_p50");
  std::vector<Obstacle> obstacles = obstaclesOf(human);
  ProximityQuery query{obstacles};
  std::vector<Placement> standing_placements = [this] {
    const Posture p = standing(human);
    return placementsOf(human, linkPoses(human.skeleton, p.q, p.root));
  }();
  static std::vector<Vec3> samplesOf(const Garment& g) {
    std::vector<Vec3> out;
    for (const NurbsPatch& p : g.patches)
      for (int j = 0; j <= 24; ++j)
        for (int i = 0; i <= 44; ++i) out.push_back(surfaceDerivatives(p, i / 44.0, j / 24.0)[0]);
    return out;
  }
};

TEST_F(ProjectedShorts, BodyIsFreeAndShrinksNoMoreThanItMust) {
  const double clearance = 0.005;
  for (const double ease : {0.06, -0.1}) {
    ShortsPattern pattern;
    pattern.ease = ease;
    const auto samples = samplesOf(makeShorts(pattern, human));
    const auto shrunk = shrinkToFree(query, obstacles, standing_placements, samples, clearance);
    int smaller = 0;
    for (std::size_t o = 0; o < obstacles.size(); ++o) {
      const int n = static_cast<int>(o);
      EXPECT_GE(nearest(query, n, shrunk[o], samples), clearance) << human.shapes[o].name;
      // The mildest change: what touched nothing stays, and 0.02 % more would touch.
      if (shrunk[o].scale == 1) continue;
      ++smaller;
      Placement larger = shrunk[o];
      larger.scale *= 1.0002;
      EXPECT_LT(nearest(query, n, larger, samples), clearance) << human.shapes[o].name;
      EXPECT_GT(shrunk[o].scale, ease > 0 ? 0.85 : 0.7) << human.shapes[o].name;
      EXPECT_LT(norm(shrunk[o].origin - standing_placements[o].origin), 1e-15);
    }
    EXPECT_GE(smaller, 2);
    for (std::size_t o = 0; o < obstacles.size(); ++o)
      if (human.shapes[o].name == "head" || human.shapes[o].name == "foot_left") {
        EXPECT_EQ(shrunk[o], standing_placements[o]);
      }
  }
}

TEST_F(ProjectedShorts, OneScaleAboutThePelvisWouldHaveToShrinkFurther) {
  const double clearance = 0.005;
  ShortsPattern pattern;
  pattern.ease = -0.1;
  const auto samples = samplesOf(makeShorts(pattern, human));
  const auto own = shrinkToFree(query, obstacles, standing_placements, samples, clearance);
  double least = 1;
  for (const Placement& X : own) least = std::min(least, X.scale);
  const Vec3 centre = standing(human).root.origin;
  bool freed = false;
  double k = 1;
  while (!freed && k > 0.1) {
    k -= 0.01;
    freed = true;
    for (std::size_t o = 0; freed && o < obstacles.size(); ++o) {
      Placement X = standing_placements[o];
      X.origin = centre + k * (X.origin - centre);
      X.scale = k;
      freed = nearest(query, static_cast<int>(o), X, samples) >= clearance;
    }
  }
  RecordProperty("whole_body_scale", std::to_string(k));
  RecordProperty("least_own_scale", std::to_string(least));
  EXPECT_LT(k, least) << "own " << least;
}

TEST_F(ProjectedShorts, SaysWhichSegmentCannotBeFreed) {
  auto samples = samplesOf(makeShorts({}, human));
  for (std::size_t o = 0; o < obstacles.size(); ++o)
    if (human.shapes[o].name == "thigh_right") samples.push_back(standing_placements[o].origin + Vec3{0.004, 0, 0});
  try {
    shrinkToFree(query, obstacles, standing_placements, samples, 0.005);
    FAIL() << "accepted";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("thigh_right"), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find("thigh_left"), std::string::npos) << e.what();
  }
  EXPECT_THROW(shrinkToFree(query, obstacles, standing_placements, samples, 0), InputError);
  EXPECT_THROW(shrinkToFree(query, obstacles, standing_placements, samples, std::nan("")), InputError);
}

}  // namespace
}  // namespace gambeson
