/// Cloth that starts inside of a body, wholly or in part, comes out, no faster than other intersections are freed.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/contact/crossing.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "unit/core/contact/mesh_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

struct Start {
  const char* name;
  double side_m;
  Vec3 corner;
  bool mesh;
};

class InsideOfABall : public testing::TestWithParam<Start> {};

TEST_P(InsideOfABall, ComesOut) {
  constexpr double radius = 0.05;
  const Start& start = GetParam();
  Garment g = squareSheet(8, start.side_m, 0);
  for (Vec3& x : g.patches[0].points) x += start.corner;
  const Shape ball = start.mesh ? Shape(testing_shapes::sphere(radius, 3)) : Shape(Ellipsoid{{radius, radius, radius}});
  Motion m(g, {{0, 0, 0}, 0.288}, {1.2e-3, 0.2, 0.01, 1e-2, 400}, {}, {{ball, "ball"}});
  const Model& model = *m.model;
  const auto deepest = [&] {
    std::vector<Vec3> x;
    samplePositions(model, m.state.p, x);
    double depth = 0;
    for (const Vec3& p : x) depth = std::max(depth, -model.proximity->signedDistance(0, {}, p));
    return depth;
  };
  EXPECT_GT(deepest(), 0.02);
  double free_s = 0, farthest_m = 0;
  Frequency frequency;
  VelocityVerlet(model, m.stage, {0.7, 1e-3}, frequency, m.work)
      .advance(0.15, m.state,
               [&](const State&, const State& after, const StepReport& r, const StepResult&, const Frequency&) {
                 for (int s = 0; s < model.surface.size(); ++s)
                   farthest_m = std::max(farthest_m, norm(m.work.x1[s] - m.work.x0[s]));
                 if (r.deepest_m > 0 || r.intersections > 0) free_s = after.time_s;
               });
  std::printf("[ measured ] %s: free at %.1f ms; %.2f cells in a step at most\n", start.name, 1e3 * free_s,
              farthest_m / (start.side_m / 8));
  EXPECT_LT(free_s, 0.12);
  EXPECT_EQ(deepest(), 0);
  EXPECT_FALSE(m.state.tangled);
  EXPECT_LT(farthest_m, 0.5 * start.side_m / 8);  // half a cell
  std::vector<Vec3> x;
  samplePositions(model, m.state.p, x);
  const CollisionModel& c = model.collisions;
  for (const auto& body : c.bodies) x.insert(x.end(), body.local.begin(), body.local.end());
  EXPECT_TRUE(findCrossings(c.mesh, x, c.is_body).empty());
}

INSTANTIATE_TEST_SUITE_P(Starts, InsideOfABall,
                         testing::Values(Start{"wholly", 0.05, {-0.026, -0.024, 0.02}, true},
                                         Start{"wholly, deep", 0.05, {-0.026, -0.024, 0.01}, true},
                                         Start{"half", 0.1, {0.003, -0.052, 0.02}, true},
                                         Start{"all around", 0.16, {-0.081, -0.078, 0.02}, true},
                                         Start{"wholly, exact ball", 0.05, {-0.026, -0.024, 0.02}, false}));

}  // namespace
}  // namespace gambeson
