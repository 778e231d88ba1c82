/// Accelerations of free points on the reference device against those of core's step.
#include "gpu/forces/point_motion.hpp"

#include <gtest/gtest.h>

#include "core/motion/forces.hpp"
#include "force_cloths.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson::gpu {
namespace {

using namespace shapes;

/// A sheet that is held at a corner, hangs on springs, one of them under a normal, is stitched to itself, and flies
/// through air.
std::unique_ptr<Model> model(double dead_N) {
  Environment environment;
  environment.drag_kg_per_m2s = 3;
  ModelOptions options;
  options.held_control_points = {0, 1};
  for (const int sample : {5, 9, 30}) options.springs.push_back({sample, sample == 9 ? 1 : 0, 40.0 + sample, -1, {}});
  options.anchor_count = 2;
  options.stitches = {{12, 40, 70, 0.3}, {13, 12, 20, 0.1}};
  if (dead_N > 0) options.dead_force_N.assign(144, Vec3{0, dead_N, -dead_N});
  return buildModel(squareSheet(10, 0.4, 1), options, environment, {}, {});
}

TEST(PointMotion, AcceleratesAsTheStepOfCoreDoes) {
  for (const double dead : {0.0, 0.01})
    for (const double half_step : {0.0, 1e-3}) {
      const auto m = model(dead);
      ASSERT_FALSE(notCarried(*m)) << *notCarried(*m);
      const int n = m->freeCount();
      std::mt19937 random(3);
      std::uniform_real_distribution<double> d(-1, 1);
      const auto some = [&] { return Vec3{d(random), d(random), d(random)}; };
      State s;
      StepWork w;
      s.p.resize(static_cast<std::size_t>(n));
      s.v.resize(s.p.size());
      m->cloth->map().Tt.multiply<Vec3>(m->cloth->rest(), s.p);
      std::vector<Vec3> half_velocity(s.p.size()), lasting(s.p.size());
      for (std::size_t i = 0; i < s.p.size(); ++i) {
        s.p[i] = m->cloth->rest()[static_cast<std::size_t>(m->cloth->map().home[i])] + 5e-3 * some();
        half_velocity[i] = some();
        lasting[i] = 10 * some();
      }
      for (std::size_t k = 0; k < m->springs.size(); ++k) s.anchors.push_back(some());
      const Vec3 air = some();
      std::vector<Placement> at(2);
      at[1].origin = {0.1, -0.2, 0.3};
      const DeformedVertices none;
      accelerate(*m, {at, none}, air, half_velocity, lasting, {half_step, 0, 0}, nullptr, s, w);

      const auto forces = forcesOnReference(*m->cloth);
      forces->setLoads(pointLoads(*m));
      std::vector<Vec3> anchors, start;
      for (std::size_t k = 0; k < m->springs.size(); ++k)
        anchors.push_back(at[static_cast<std::size_t>(m->springs[k].anchor)] * s.anchors[k]);
      for (std::size_t i = 0; i < s.p.size(); ++i) start.push_back(half_velocity[i] + half_step * lasting[i]);
      forces->setAnchors(anchors, std::vector<Vec3>(anchors.size()));
      forces->setFree(s.p);
      forces->setVelocities(start);
      forces->placePoints();
      forces->evaluate();
      forces->freeForces();
      forces->accelerate(air, half_step);
      EXPECT_LT(farthest(forces->acceleration(), s.a), 1e-13 * largest(s.a));
      EXPECT_LT(farthest(forces->velocity(), s.v), 1e-13 * largest(s.v));
      EXPECT_EQ(forces->acceleration()[0], Vec3{});
    }
}

/// Along its normal a spring does not pull; springs within the cloth leave its momentum.
TEST(PointMotion, SpringsPullAcrossTheirNormalAndStitchesCancel) {
  const auto m = model(0);
  const PointLoads loads = pointLoads(*m);
  ASSERT_EQ(loads.anchored, 3);
  ASSERT_EQ(loads.springs.rows(), 5);
  const auto forces = forcesOnReference(*m->cloth);
  PointLoads own = loads;
  own.gravity_m_per_s2 = {};
  std::ranges::fill(own.drag_kg_per_s, 0.0);
  std::ranges::fill(own.held, 0);
  const auto pulledBy = [&](const Vec3& normal) {
    forces->setLoads(own);
    std::vector<Vec3> p;
    for (const int home : m->cloth->map().home) p.push_back(m->cloth->rest()[static_cast<std::size_t>(home)]);
    forces->setFree(p);
    forces->setAnchors(std::vector<Vec3>(3, Vec3{0.1, 0.2, 0.3}), std::vector<Vec3>(3, normal));
    forces->setVelocities(std::vector<Vec3>(p.size()));
    forces->placePoints();
    forces->evaluate();
    forces->freeForces();
    forces->accelerate({}, 0);
    Vec3 sum;
    const std::vector<Vec3> a = forces->acceleration();
    for (std::size_t i = 0; i < a.size(); ++i) sum += own.mass_kg[i] * a[i];
    return sum;
  };
  Vec3 expected;
  for (std::size_t k = 0; k < m->springs.size(); ++k) {
    Vec3 x;
    const SparseRows& WT = m->surface.WT;
    for (int e = WT.offsets[m->springs[k].sample]; e < WT.offsets[m->springs[k].sample + 1]; ++e)
      x += WT.values[e] * m->cloth->rest()[static_cast<std::size_t>(m->cloth->map().home[WT.columns[e]])];
    expected += m->springs[k].stiffness_N_per_m * (Vec3{0.1, 0.2, 0.3} - x);
  }
  EXPECT_LT(norm(pulledBy({}) - expected), 1e-10 * norm(expected));
  expected.z = 0;
  EXPECT_LT(norm(pulledBy({0, 0, 1}) - expected), 1e-10 * norm(expected));
}

}  // namespace
}  // namespace gambeson::gpu
