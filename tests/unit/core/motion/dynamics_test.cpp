/// The explicit scheme (Zheng 2013, section 3.1): free fall with drag against the closed form, order of convergence,
/// and impacts of fast bodies.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// Falling through wind w: v = (g/c + w)(1 - exp(-c t)), x = (g/c + w)(t - (1 - exp(-c t))/c), c = eta/rho = 2/s.
TEST(Step, FreeFallWithDragConvergesToTheClosedFormWithSecondOrder) {
  const double end = 0.5, c = 2;
  const Vec3 limit{0.3, 0.4, -9.81 / c};
  double v_error[3], x_error[3];
  for (int k = 0; k < 3; ++k) {
    Motion m(squareSheet(4, 0.2, 1), {{0, 0, -9.81}, 0.288});
    m.stage.wind = {0.3, 0.4, 0};
    m.restart();
    const std::vector<Vec3> start = m.state.p;
    const int steps = 500 << k;
    for (int s = 0; s < steps; ++s) ASSERT_EQ(m.step(end / steps).failure, StepFailure::none);
    const Vec3 v = (1 - std::exp(-c * end)) * limit, x = (end - (1 - std::exp(-c * end)) / c) * limit;
    v_error[k] = x_error[k] = 0;
    for (std::size_t i = 0; i < start.size(); ++i) {
      v_error[k] = std::max(v_error[k], norm(m.state.v[i] - v) / norm(v));
      x_error[k] = std::max(x_error[k], norm(m.state.p[i] - start[i] - x) / norm(x));
    }
  }
  EXPECT_LT(v_error[2], 1e-7);
  EXPECT_LT(x_error[2], 1e-7);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(std::log2(v_error[k] / v_error[k + 1]), 2, 0.05);
    EXPECT_NEAR(std::log2(x_error[k] / x_error[k + 1]), 2, 0.05);
  }
}

TEST(Step, VibrationConvergesWithSecondOrder) {
  std::vector<std::vector<Vec3>> p;
  for (int steps : {200, 400, 800, 1600}) {
    Motion m = vibration();
    for (int s = 0; s < steps; ++s) ASSERT_EQ(m.step(0.04 / steps).failure, StepFailure::none);
    p.push_back(m.state.p);
  }
  const auto distance = [&](int a, int b) {
    double most = 0;
    for (std::size_t i = 0; i < p[a].size(); ++i) most = std::max(most, norm(p[a][i] - p[b][i]));
    return most;
  };
  EXPECT_GT(distance(0, 1), 1e-9);
  for (int k : {0, 1}) EXPECT_NEAR(std::log2(distance(k, k + 1) / distance(k + 1, k + 2)), 2, 0.15);
}

/// Section 3.3: at 50 m/s a step of 1 ms is 50 mm, through a body 4 mm thick and tilted by 20 degrees, with room to
/// spare.
struct Shot {
  std::vector<Vec3> x;
  int contacts = 0;
};
Shot shoot(double cloth_m_per_s, double body_m_per_s) {
  Fabric f = sheetFabric();
  f.young_weft_Pa = f.young_warp_Pa = 3e3;
  f.shear_Pa = 1e3;
  const Mat3 tilt = rotationAbout({0, 1, 0}, M_PI / 9);
  Motion m(squareSheet(4, 0.1, 0.07, f), {{0, 0, 0}, 0}, {1e-3, 0.3, 0.01, 1e-2, 400}, {},
           {{Ellipsoid{{0.3, 0.3, 0.002}}, "blade"}}, {{tilt, {0.05, 0.05, 0}, 1}}, {{0, 0, body_m_per_s}});
  for (Vec3& v : m.state.v) v = {0, 0, cloth_m_per_s};
  m.restart();
  Shot shot;
  for (int s = 0; s < 20; ++s) {
    const StepReport r = m.step(1e-3);
    EXPECT_EQ(r.failure, StepFailure::none) << r.why;
    shot.contacts += static_cast<int>(m.work.contact_impulses.size());
    samplePositions(*m.model, m.state.p, shot.x);
    const Vec3 centre{0.05, 0.05, body_m_per_s * m.state.time_s};
    for (const Vec3& x : shot.x) {
      const Vec3 local = transposeTimes(tilt, x - centre);
      EXPECT_GT(m.model->proximity->signedDistance(0, {tilt, centre, 1}, x), 0);
      EXPECT_TRUE(local.z > 0 || std::hypot(local.x, local.y) > 0.3);
    }
  }
  for (Vec3& x : shot.x) x.z -= body_m_per_s * m.state.time_s;
  return shot;
}

TEST(Step, NothingPassesAThinBodyAtSpeed) {
  const Shot moving = shoot(-50, 0);
  EXPECT_GE(moving.contacts, 64);
}

TEST(Step, OnlyTheRelativeMotionCounts) {
  const Shot cloth = shoot(-50, 0), body = shoot(0, 50), both = shoot(-20, 30);
  for (std::size_t i = 0; i < cloth.x.size(); ++i) {
    EXPECT_LT(norm(cloth.x[i] - body.x[i]), 1e-6);
    EXPECT_LT(norm(cloth.x[i] - both.x[i]), 1e-6);
  }
}

/// A blade that turns by 0.1 rad a step, tip at 30 m/s, sweeps a sheet away: chord velocities of the touched points do
/// not say all here, the paths against the turning body do; steps in which they find no way out are halved.
TEST(Step, NothingPassesATurningBlade) {
  class Spin : public Stage {
   public:
    void placements(double t, std::span<Placement> obstacles, std::span<Placement>) const override {
      obstacles[0] = {rotationAbout({0, 1, 0}, -100 * t), {}, 1};
    }
  };
  Fabric f = sheetFabric();
  f.young_weft_Pa = f.young_warp_Pa = 3e3;
  f.shear_Pa = 1e3;
  Garment g = squareSheet(6, 0.1, 0.05, f);
  for (Vec3& x : g.patches[0].points) x.x += 0.15, x.y -= 0.05;
  Motion m(g, {{0, 0, 0}, 0}, {1e-3, 0.3, 0.01, 1e-2, 400}, {}, {{Ellipsoid{{0.3, 0.2, 0.002}}, "blade"}});
  const Spin spin;
  Frequency frequency;
  int impacts = 0, steps = 0;
  double closest = 1, shortest = 1;
  std::vector<Vec3> x;
  VelocityVerlet(*m.model, spin, {}, frequency, m.work)
      .advance(0.012, m.state,
               [&](const State&, const State& after, const StepReport& r, const StepResult&, const Frequency&) {
                 impacts += r.impacts;
                 ++steps;
                 shortest = std::min(shortest, r.step_s);
                 Placement at;
                 spin.placements(after.time_s, {&at, 1}, {});
                 samplePositions(*m.model, after.p, x);
                 for (const Vec3& p : x) {
                   closest = std::min(closest, m.model->proximity->signedDistance(0, at, p));
                   const Vec3 local = toLocal(at, p);  // on its side, or flung off beyond the rim
                   EXPECT_TRUE(local.z > 0 || std::pow(local.x / 0.3, 2) + std::pow(local.y / 0.2, 2) > 1);
                 }
               });
  std::printf("[ measured ] closest %.3g mm, %d impacts, %d steps down to %.3g us\n", 1e3 * closest, impacts, steps,
              1e6 * shortest);
  EXPECT_GT(closest, 0);
  EXPECT_GT(impacts, 0);
}

TEST(Advance, EndsAtTheTimeAndSaysWhyItCannot) {
  Motion m = vibration();
  Frequency f;
  int steps = 0;
  double last = 0;
  VelocityVerlet(*m.model, m.stage, {}, f, m.work)
      .advance(
          0.0137, m.state,
          [&](const State& before, const State& after, const StepReport& r, const StepResult&, const Frequency& now) {
            EXPECT_EQ(before.time_s, last);
            EXPECT_NEAR(after.time_s, before.time_s + r.step_s, 1e-15);
            EXPECT_LE(r.step_s, 0.9 * 2 / before.frequency_rad_per_s * (1 + 1e-9));
            EXPECT_GT(now.largest_rad_per_s, 0);
            last = after.time_s;
            ++steps;
          });
  EXPECT_EQ(m.state.time_s, 0.0137);
  EXPECT_GT(steps, 10);
  m.state.v[20].z = std::nan("");
  EXPECT_EQ(m.step(1e-6).failure, StepFailure::not_finite);
  const auto ignore = [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {};
  try {
    VelocityVerlet(*m.model, m.stage, {}, f, m.work).advance(0.02, m.state, ignore);
    ADD_FAILURE() << "a velocity that is not a number went through";
  } catch (const RunError& e) {
    EXPECT_NE(std::string(e.what()).find("no step at time 0.0137"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("not finite"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace gambeson
