// Projection onto ellipsoids along the gradient (Man 2006, section 3.3.3 and box 5).
#include "core/contact/projection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/contact/ellipsoid.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

/// The upper arm of cases/library/arm_body.json.
const Ellipsoid arm{{0.175, 0.0570, 0.0570}};

Vec3 randomDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized(Vec3{normal(random), normal(random), normal(random)});
}

/// A point at a depth under a random point of the surface, and that point.
std::pair<Vec3, Vec3> under(const EllipsoidMetric& e, double depth, std::mt19937& random) {
  const Vec3 u = randomDirection(random);
  const Vec3 surface{u.x * e.semi_axes.x, u.y * e.semi_axes.y, u.z * e.semi_axes.z};
  const Vec3 n = normalized(Vec3{surface.x * e.inverse2.x, surface.y * e.inverse2.y, surface.z * e.inverse2.z});
  return {surface - depth * n, surface};
}

TEST(Projection, LandsOnTheSurfaceNearTheClosestPoint) {
  const EllipsoidMetric e = ellipsoidMetric(arm);
  std::mt19937 random(1);
  double off[2] = {};
  const double depths[2] = {1e-3, 1e-4};
  double worst = 0;
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 20000; ++i) {
      const auto [p, closest] = under(e, depths[k], random);
      const GradientFoot foot = footAlongGradient(e, p);
      const Vec3 x = p + foot.distance_m * foot.direction;
      EXPECT_GT(foot.distance_m, 0);
      worst = std::max(worst, std::abs(ellipsoidFunction(e, x)));
      off[k] = std::max(off[k], norm(x - closest));
    }
  std::printf("[ measured ] |f| at most %.3g; off the closest point %.3g um at 1 mm, %.3g um at 0.1 mm\n", worst,
              1e6 * off[0], 1e6 * off[1]);
  EXPECT_LE(worst, 1e-12);
  EXPECT_LE(off[0], 20e-6);
  EXPECT_GT(off[0], 10e-6);  // it is not the closest point
}

TEST(Projection, GoesInwardsFromOutsideAndOutFromTheCentre) {
  const EllipsoidMetric e = ellipsoidMetric(arm);
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p = under(e, -1e-3, random).first;
    const GradientFoot foot = footAlongGradient(e, p);
    EXPECT_LT(foot.distance_m, 0);
    EXPECT_LE(std::abs(ellipsoidFunction(e, p + foot.distance_m * foot.direction)), 1e-12);
  }
  const GradientFoot centre = footAlongGradient(e, {});
  EXPECT_EQ(centre.distance_m, 0.0570);
  EXPECT_NEAR(ellipsoidFunction(e, centre.distance_m * centre.direction), 0, 1e-15);
}

/// One point of 1 g that meets the arm where that stands at the end of the step, turned and moved.
struct Meeting {
  std::vector<Obstacle> obstacles{{arm, "arm"}};
  std::vector<Placement> start{1}, end{1};
  ContactParameters parameters{1e-3, 0.3, 0.01};
  SparseRows WT{1, {0, 1}, {0}, {1.0}};
  std::vector<double> inverse{1e3}, area{1e-4}, density{10};
  std::vector<Vec3> x0{Vec3{}}, velocity{Vec3{}}, warm{Vec3{}}, impulses{Vec3{}};
  double dt = 1e-4;
  RowLayer layer{1e-3};
  ContactWork work;
  MethodWork scratch;
  Projection method;
  ContactRow row;

  ContactSolve solve() {
    const MethodStep step{WT, inverse, area, density, {}, obstacles, start, end, x0, parameters, dt};
    const EllipsoidMetric e = ellipsoidMetric(arm);
    const SurfacePoint foot = closestOnEllipsoid(e, toLocal(start[0], x0[0]));
    Contact c;
    c.local = foot.position;
    c.normal = start[0].rotation * foot.normal;
    c.gap_m = foot.distance_m;
    row = bodyRow(c, (end[0] * c.local - start[0] * c.local) / dt, 0, false);
    method.prepare(step, layer, row);
    return method.solve(step, {{&row, 1}, {&layer, 1}}, velocity, warm, impulses, work, scratch);
  }
  /// f of the ellipsoid with its layer, of the point at the end.
  double f() const {
    const EllipsoidMetric e = ellipsoidMetric({arm.semi_axes + Vec3{layer.m, layer.m, layer.m}});
    return ellipsoidFunction(e, toLocal(end[0], x0[0] + dt * velocity[0]));
  }
};

TEST(Projection, AStepEndsOnTheMovedSurface) {
  std::mt19937 random(3);
  const EllipsoidMetric grown = ellipsoidMetric({arm.semi_axes + Vec3{1e-3, 1e-3, 1e-3}});
  double worst = 0;
  for (int i = 0; i < 500; ++i) {
    Meeting m;
    const Vec3 axis = randomDirection(random);
    m.start[0].rotation = rotationAbout(axis, 0.7);
    m.end[0].rotation = rotationAbout(axis, 0.7 + 5 * m.dt);
    m.end[0].origin = m.dt * 0.5 * randomDirection(random);
    m.x0[0] = m.start[0] * under(grown, -2e-5, random).first;
    const Vec3 inwards = -(m.start[0].rotation * closestOnEllipsoid(grown, toLocal(m.start[0], m.x0[0])).normal);
    m.velocity[0] = 2 * inwards + 0.5 * randomDirection(random);
    const Vec3 before = m.velocity[0];
    const ContactSolve solve = m.solve();
    EXPECT_TRUE(solve.converged);
    worst = std::max(worst, std::abs(m.f()));
    ASSERT_GT(norm(m.impulses[0]), 0);
    // Momentum: what the point got is what the row says. Friction is in its cone.
    EXPECT_LT(norm((m.velocity[0] - before) / m.inverse[0] - m.impulses[0]), 1e-15 * norm(m.impulses[0]) + 1e-18);
    EXPECT_LT(norm(m.warm[0] - m.impulses[0] / 1e-4), 1e-12 * norm(m.warm[0]));
    const double pressed = dot(m.impulses[0], m.row.contact.normal);
    EXPECT_LE(norm(m.impulses[0] - pressed * m.row.contact.normal), 0.31 * pressed);
  }
  std::printf("[ measured ] |f| after a step with friction: at most %.3g\n", worst);
  EXPECT_LE(worst, 1e-12);
}

TEST(Projection, WhatStaysOutsideIsLeftAlone) {
  Meeting m;
  m.x0[0] = {0, 0, 0.0570 + 2e-3};
  m.velocity[0] = {0.3, 0, -1};
  m.solve();
  EXPECT_EQ(m.velocity[0], (Vec3{0.3, 0, -1}));
  EXPECT_EQ(m.impulses[0], Vec3{});
}

/// Inside of the layer at the start it comes out in the relaxation time, not in a step.
TEST(Projection, WhatStartsInTheLayerComesOutSlowly) {
  Meeting m;
  m.x0[0] = {0, 0, 0.0570 + 0.4e-3};
  m.solve();
  EXPECT_NEAR(m.velocity[0].z, -std::expm1(-m.dt / 0.01) * 0.6e-3 / m.dt, 1e-12);
}

/// A surface between two ellipsoids: the node ends outside of both.
TEST(Projection, ANodeInTwoBodiesEndsOutsideOfBoth) {
  Meeting m;
  const Ellipsoid ball{{0.05, 0.05, 0.05}};
  m.obstacles = {{ball, "a"}, {ball, "b"}};
  m.start.resize(2), m.end.resize(2);
  m.start[0].origin = m.end[0].origin = {-0.04, 0, 0};
  m.start[1].origin = m.end[1].origin = {0.04, 0, 0};
  const double crease = std::sqrt(0.051 * 0.051 - 0.04 * 0.04);
  m.x0[0] = {1e-5, 0, crease + 2e-5};
  m.velocity[0] = {0, 0, -1};
  m.parameters.friction = 0;
  const MethodStep step{m.WT, m.inverse, m.area, m.density, {}, m.obstacles, m.start, m.end, m.x0, m.parameters, m.dt};
  std::vector<ContactRow> rows;
  std::vector<RowLayer> layer(2, m.layer);
  for (int o = 0; o < 2; ++o) {
    const SurfacePoint foot = closestOnEllipsoid(ellipsoidMetric(ball), toLocal(m.start[o], m.x0[0]));
    Contact c;
    c.obstacle = o;
    c.local = foot.position;
    c.normal = foot.normal;
    c.gap_m = foot.distance_m;
    rows.push_back(bodyRow(c, {}, 0, false));
    m.method.prepare(step, m.layer, rows.back());
  }
  std::vector<Vec3> warm(2), impulses(2);
  EXPECT_TRUE(m.method.solve(step, {rows, layer}, m.velocity, warm, impulses, m.work, m.scratch).converged);
  const Vec3 x = m.x0[0] + m.dt * m.velocity[0];
  for (int o = 0; o < 2; ++o) EXPECT_GE(norm(x - m.start[o].origin), 0.051 - 1e-10) << o;
  EXPECT_GT(norm(impulses[0]), 0);
  EXPECT_GT(norm(impulses[1]), 0);
}

TEST(Projection, OtherClothAndBodiesAreRefused) {
  const SparseRows nodes{2, {0, 1, 2}, {0, 1}, {1.0, 1.0}}, between{2, {0, 1, 3}, {0, 0, 1}, {1.0, 0.5, 0.5}};
  const TriangleMesh flat{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}},
      folded{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.1}}, {{0, 1, 2}, {0, 2, 3}}};
  const std::vector<Obstacle> allowed{{arm, "arm"}, {flat, "floor"}}, mesh{{arm, "arm"}, {folded, "seat"}};
  EXPECT_NO_THROW(checkProjection(nodes, allowed));
  const auto refusal = [&](const SparseRows& WT, std::span<const Obstacle> obstacles) {
    try {
      checkProjection(WT, obstacles);
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, "contact.method");
      EXPECT_NE(e.reason().find("allowed"), std::string::npos) << e.reason();
      return e.reason();
    }
    ADD_FAILURE() << "accepted";
    return std::string();
  };
  EXPECT_NE(refusal(between, allowed).find("several points"), std::string::npos);
  EXPECT_NE(refusal(nodes, mesh).find("\"seat\""), std::string::npos);
  std::vector<Obstacle> bending = allowed;
  bending[1].deforms = true;
  EXPECT_NE(refusal(nodes, bending).find("\"floor\""), std::string::npos);
}

}  // namespace
}  // namespace gambeson
