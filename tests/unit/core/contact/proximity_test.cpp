/// Who is near whom, and who would pass through whom.
#include "core/contact/proximity.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <limits>
#include <random>

#include "core/contact/ellipsoid.hpp"
#include "core/error.hpp"
#include "unit/core/contact/mesh_shapes.hpp"

namespace gambeson {
namespace {

using namespace testing_shapes;

struct Scene {
  std::vector<Obstacle> obstacles;
  std::vector<Placement> start, end;
  std::vector<Vec3> x0, x1;
};

std::vector<Contact> nearOf(const Scene& s, double reach) {
  std::vector<Contact> out;
  ProximityQuery(s.obstacles).near(s.start, s.end, s.x0, std::vector<double>(s.x0.size(), reach), out);
  return out;
}
std::vector<SampleHit> impactsOf(const Scene& s) {
  std::vector<SampleHit> out;
  ProximityQuery(s.obstacles).impacts(s.start, s.end, s.x0, s.x1, out);
  return out;
}
Scene one(Shape shape, std::vector<Vec3> x, Placement X = {}) {
  Scene s;
  s.obstacles.emplace_back();
  s.obstacles[0].shape = std::move(shape);
  s.start = s.end = {X};
  s.x0 = s.x1 = std::move(x);
  return s;
}

Mat3 randomRotation(std::mt19937& rng, double angle) {
  std::normal_distribution<double> g;
  return rotationAbout(normalized({g(rng), g(rng), g(rng)}), angle);
}

/// Ellipsoids and meshes at random places, turned, scaled and moving, with samples all around.
Scene randomScene(unsigned seed, int n_samples) {
  std::mt19937 rng(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  Scene s;
  for (int o = 0; o < 8; ++o) {
    s.obstacles.emplace_back();
    if (o % 2)
      s.obstacles[o].shape = o == 3 ? torus(0.2, 0.07, 24, 12) : box({0.1, 0.2, 0.05});
    else
      s.obstacles[o].shape = Ellipsoid{{0.1 + 0.05 * u(rng), 0.3, 0.2}};
    Placement X{randomRotation(rng, 3 * u(rng)), 0.5 * Vec3{u(rng), u(rng), u(rng)}, 1 + 0.3 * u(rng)};
    s.start.push_back(X);
    X.rotation = randomRotation(rng, 0.2 * u(rng)) * X.rotation;
    X.origin += 0.1 * Vec3{u(rng), u(rng), u(rng)};
    X.scale *= 1 + 0.1 * u(rng);
    s.end.push_back(X);
  }
  for (int i = 0; i < n_samples; ++i) {
    s.x0.push_back(0.8 * Vec3{u(rng), u(rng), u(rng)});
    s.x1.push_back(s.x0.back() + 0.4 * Vec3{u(rng), u(rng), u(rng)});
  }
  return s;
}

TEST(ProximityNear, SphereGapNormalAndMaterialPoint) {
  Placement X{rotationAbout({0, 0, 1}, M_PI / 2), {1, 2, 3}, 2};
  // Radius 0.5 scaled by 2, approached from world +x, which is local -y.
  const auto c = nearOf(one(Ellipsoid{{0.5, 0.5, 0.5}}, {{2.01, 2, 3}, {2.03, 2, 3}}, X), 0.02);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_EQ(c[0].sample, 0);
  EXPECT_NEAR(c[0].gap_m, 0.01, 1e-15);
  EXPECT_NEAR(norm(c[0].normal - Vec3{1, 0, 0}), 0, 1e-14);
  EXPECT_NEAR(norm(c[0].local - Vec3{0, -0.5, 0}), 0, 1e-14);
}

TEST(ProximityNear, ReachGrowsByWhatTheObstacleMoves) {
  Scene s = one(Ellipsoid{{0.5, 0.5, 0.5}}, {{0.7, 0, 0}});
  EXPECT_TRUE(nearOf(s, 0.1).empty());
  s.end[0].origin = {0.15, 0, 0};
  const auto c = nearOf(s, 0.1);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_NEAR(c[0].gap_m, 0.2, 1e-15) << "the gap is that at the start";
}

TEST(ProximityNear, EveryPairOfARandomSceneIsFound) {
  const Scene s = randomScene(11, 3000);
  const double reach = 0.05;
  const auto contacts = nearOf(s, reach);
  const ProximityQuery query(s.obstacles);
  std::size_t k = 0, pairs = 0;
  for (int i = 0; i < static_cast<int>(s.x0.size()); ++i)
    for (int o = 0; o < static_cast<int>(s.obstacles.size()); ++o) {
      const double d = query.signedDistance(o, s.start[o], s.x0[i]);
      double least = std::numeric_limits<double>::infinity();
      for (; k < contacts.size() && contacts[k].sample == i && contacts[k].obstacle == o; ++k) {
        const Contact& c = contacts[k];
        least = std::min(least, c.gap_m);
        EXPECT_NEAR(norm(c.normal), 1, 1e-12);
        EXPECT_NEAR(norm(s.start[o] * c.local + c.gap_m * c.normal - s.x0[i]), 0, 1e-8);
        EXPECT_GE(c.gap_m, d - 1e-12);
      }
      if (d < reach) {
        EXPECT_NEAR(least, d, 1e-12) << i << " " << o;
      }
      if (least < reach) ++pairs;
    }
  EXPECT_EQ(k, contacts.size()) << "sorted by sample and obstacle, and nothing else in it";
  EXPECT_GT(pairs, 200u);
}

TEST(ProximityNear, ASampleThatSlidesOverAPlaneSeesOneContact) {
  std::mt19937 rng(12);
  const Placement X{randomRotation(rng, 1), {0.3, -2, 1}, 1.3};
  std::vector<Vec3> local;
  for (int i = 0; i <= 2000; ++i) {
    const double t = 0.05 + 0.9 * i / 2000;
    local.push_back({t, t, 0.01});                                             // along diagonals, over vertices
    local.push_back({t, 0.5, 0.01});                                           // along an inner edge
    local.push_back({t, 0.2 + 0.4 * t, i % 2 ? 1e-13 : 0.0});                  // on the surface
    local.push_back({0.1 * (i % 9 + 1), 0.1 * (i % 7 + 1), 0.02 * i / 2000});  // over vertices
  }
  std::vector<Vec3> x;
  for (const Vec3& p : local) x.push_back(X * p);
  const Scene s = one(plane(10), x, X);
  const auto c = nearOf(s, 0.05);
  ASSERT_EQ(c.size(), x.size());
  for (std::size_t i = 0; i < c.size(); ++i) {
    ASSERT_EQ(c[i].sample, static_cast<int>(i));
    ASSERT_NEAR(norm(c[i].normal - X.rotation * Vec3{0, 0, 1}), 0, 1e-12);
    ASSERT_NEAR(c[i].gap_m, 1.3 * local[i].z, 1e-14 * 10);
  }
}

TEST(ProximityNear, ConcaveCornerGivesTwoContactsAndAConvexEdgeOne) {
  // Two half planes meeting at the y axis: floor z = 0 for x > 0 and wall x = 0 for z > 0.
  TriangleMesh concave;
  concave.vertices = {{0, -1, 0}, {1, -1, 0}, {1, 1, 0}, {0, 1, 0}, {0, -1, 1}, {0, 1, 1}};
  concave.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 5, 4}};
  auto c = nearOf(one(concave, {{0.01, 0.3, 0.02}, {0.01, 0.3, 0.5}, {0.01, -1e-9, 0.01}}), 0.05);
  ASSERT_EQ(c.size(), 5u);
  EXPECT_NEAR(c[0].gap_m, 0.02, 1e-15);
  EXPECT_EQ(c[0].normal, (Vec3{0, 0, 1}));
  EXPECT_NEAR(c[1].gap_m, 0.01, 1e-15);
  EXPECT_EQ(c[1].normal, (Vec3{1, 0, 0}));
  EXPECT_EQ(c[2].sample, 1);
  EXPECT_EQ(c[3].sample, 2);
  EXPECT_EQ(c[4].sample, 2);
  // In the very corner both walls are felt.
  c = nearOf(one(concave, {{0, 0.3, 0}, {1e-14, 0.3, -1e-14}}), 0.05);
  EXPECT_EQ(c.size(), 4u);

  const double h = 0.01;
  c = nearOf(one(box({0.5, 0.5, 0.5}), {{0.5 + h, 0.5 + h, 0.1}, {0.5 + h, 0.5 + h, 0.5 + h}, {0.5 + h, 0.2, 0}}),
             0.05);
  ASSERT_EQ(c.size(), 3u);
  EXPECT_NEAR(c[0].gap_m, h * std::sqrt(2), 1e-15);
  EXPECT_NEAR(norm(c[0].normal - normalized({1, 1, 0})), 0, 1e-13);
  EXPECT_NEAR(c[1].gap_m, h * std::sqrt(3), 1e-15);
  EXPECT_NEAR(norm(c[1].normal - normalized({1, 1, 1})), 0, 1e-13);
  EXPECT_LT(c[2].feature, 12);
  EXPECT_GE(c[0].feature, 12) << "an edge";
  EXPECT_GE(c[1].feature, 12 + 18) << "a vertex";
}

TEST(ProximityNear, OutsideAThinPlateItsFarSideIsNotSeenAndInsideTheWayOutIs) {
  const TriangleMesh plate = box({0.5, 0.5, 0.0005});
  const auto c = nearOf(one(plate, {{0.1, 0.2, 0.001}, {0.1, 0.2, 0.0004}, {0.1, 0.2, -0.0004}}), 0.01);
  ASSERT_EQ(c.size(), 3u);
  EXPECT_NEAR(c[0].gap_m, 0.0005, 1e-15);
  EXPECT_NEAR(c[1].gap_m, -0.0001, 1e-15);
  EXPECT_EQ(c[1].normal, (Vec3{0, 0, 1}));
  EXPECT_NEAR(c[2].gap_m, -0.0001, 1e-15);
  EXPECT_EQ(c[2].normal, (Vec3{0, 0, -1}));
}

TEST(ProximityNear, ASampleDeepInAClosedMeshIsReported) {
  const auto c = nearOf(one(box({0.5, 0.4, 0.3}), {{0.0, 0.1, 0.05}}), 0.001);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_NEAR(c[0].gap_m, -0.25, 1e-15);
  EXPECT_EQ(c[0].normal, (Vec3{0, 0, 1}));
}

TEST(ProximityImpact, SphereFrontalAndThrough) {
  Scene s = one(Ellipsoid{{1, 1, 1}}, {{-3, 0, 0}, {-3, 0, 0}, {-3, 2, 0}, {0.5, 0, 0}, {-1, 0, 0}});
  s.x1 = {{0, 0, 0}, {100, 0, 0}, {3, 2, 0}, {0, 0, 0}, {-0.5, 0, 0}};
  const auto c = impactsOf(s);
  ASSERT_EQ(c.size(), 3u);
  for (const Contact& k : c) EXPECT_EQ(k.normal, (Vec3{-1, 0, 0}));
  EXPECT_NEAR(c[0].time, 2. / 3, 1e-15);
  EXPECT_EQ(c[1].sample, 1);
  EXPECT_NEAR(c[1].gap_m, 2, 1e-13);
  EXPECT_NEAR(c[1].time, 2. / 103, 1e-15);
  EXPECT_EQ(c[2].sample, 4) << "starts on the surface and moves inward";
  EXPECT_EQ(c[2].gap_m, 0);
}

TEST(ProximityImpact, AMovingEllipsoidHitsARestingSample) {
  Scene s = one(Ellipsoid{{0.2, 0.1, 0.1}}, {{0, 0, 0}});
  s.start[0].origin = {1, 0, 0};
  s.end[0].origin = {-1, 0, 0};
  auto c = impactsOf(s);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_NEAR(c[0].gap_m, 0.8, 1e-15);
  EXPECT_NEAR(norm(c[0].local - Vec3{-0.2, 0, 0}), 0, 1e-15);
  // Turning by a quarter about z sweeps the long axis over a sample beside it.
  s = one(Ellipsoid{{0.5, 0.1, 0.1}}, {{0, 0.3, 0}});
  s.end[0].rotation = rotationAbout({0, 0, 1}, M_PI / 2);
  c = impactsOf(s);
  ASSERT_EQ(c.size(), 1u);
  // Growing (virtual projecting) reaches it too.
  s = one(Ellipsoid{{0.1, 0.1, 0.1}}, {{0, 0.3, 0}});
  s.end[0].scale = 3.01;
  c = impactsOf(s);
  ASSERT_EQ(c.size(), 1u);
  EXPECT_NEAR(c[0].gap_m, 0.2, 1e-15);
}

TEST(ProximityImpact, TheChordInTheFrameOfAFastTurningObstacleIsNotCulled) {
  // Half a turn within the step: in the ball's frame the resting sample crosses from one side to the other. The path is
  // defined as that chord, which leaves the box of the ball and the sample's place in the world far apart.
  Scene s = one(Ellipsoid{{0.1, 0.1, 0.1}}, {{0, 0.3, 0}});
  s.end[0].rotation = rotationAbout({0, 0, 1}, M_PI);
  EXPECT_EQ(impactsOf(s).size(), 1u);
}

TEST(ProximityImpact, NoPairOfARandomSceneIsCulledWrongly) {
  for (unsigned seed : {21u, 22u}) {
    const Scene s = randomScene(seed, 8000);
    const auto contacts = impactsOf(s);
    std::size_t k = 0;
    for (int i = 0; i < static_cast<int>(s.x0.size()); ++i)
      for (int o = 0; o < static_cast<int>(s.obstacles.size()); ++o) {
        const bool reported = k < contacts.size() && contacts[k].sample == i && contacts[k].obstacle == o;
        const Vec3 p0 = toLocal(s.start[o], s.x0[i]), p1 = toLocal(s.end[o], s.x1[i]);
        if (const auto* e = std::get_if<Ellipsoid>(&s.obstacles[o].shape)) {
          ASSERT_EQ(reported, ellipsoidEntry(ellipsoidMetric(*e), p0, p1).has_value()) << i << " " << o;
        } else {
          ASSERT_FALSE(reported) << "meshes are not asked";
        }
        if (reported) ++k;
      }
    EXPECT_EQ(k, contacts.size());
    EXPECT_GT(k, 200u);
  }
}

TEST(Proximity, TheSameBitsForAnyNumberOfThreads) {
  const Scene s = randomScene(31, 5000);
  const int before = omp_get_max_threads();
  omp_set_num_threads(1);
  const auto near1 = nearOf(s, 0.1);
  const auto impacts1 = impactsOf(s);
  const auto same = [](const auto& a, const auto& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Contact &p = a[i], &q = b[i];
      ASSERT_TRUE(p.sample == q.sample && p.obstacle == q.obstacle && p.feature == q.feature && p.normal == q.normal &&
                  p.gap_m == q.gap_m && p.local == q.local);
    }
  };
  for (int threads : {2, 3}) {
    omp_set_num_threads(threads);
    same(near1, nearOf(s, 0.1));
    same(impacts1, impactsOf(s));
  }
  omp_set_num_threads(before);
  ASSERT_GT(near1.size(), 500u);
}

TEST(Proximity, BadInputIsRefused) {
  const auto build = [](Shape shape) {
    std::vector<Obstacle> obstacles(1);
    obstacles[0].shape = std::move(shape);
    obstacles[0].segment = "thigh";
    ProximityQuery q(obstacles);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(build(Ellipsoid{{1, 0, 1}}), InputError);
  EXPECT_THROW(build(TriangleMesh{}), InputError);
  TriangleMesh m = box({1, 1, 1});
  m.triangles[3][1] = 8;
  EXPECT_THROW(build(m), InputError);
  m = box({1, 1, 1});
  m.vertices[2].y = nan;
  EXPECT_THROW(build(m), InputError);
  m = box({1, 1, 1});
  std::swap(m.triangles[5][0], m.triangles[5][1]);
  EXPECT_THROW(build(m), InputError) << "one triangle faces the wrong way";
  m = box({1, 1, 1});
  for (auto& t : m.triangles) std::swap(t[0], t[1]);
  EXPECT_THROW(build(m), InputError) << "inside out";
  EXPECT_THROW(nearOf(one(Ellipsoid{{1, 1, 1}}, {{0, nan, 0}}), 0.1), RunError);
  try {
    build(Ellipsoid{{1, -2, 1}});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("thigh"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("-2"), std::string::npos);
  }
}

}  // namespace
}  // namespace gambeson
