/// Velocities at whole steps hold the half of what presses: cloth that a body bears at rest has none, and drag does not
/// act on it.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "unit/core/contact/mesh_shapes.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

constexpr double kLayer_m = 1e-3, kStep_s = 2e-4;

/// A sheet at `gap` above the layer of a box's top, gravity tilted by atan(slope) towards x.
Motion sheetOnBox(double drag, double slope, double gap, double friction = 0.3) {
  Garment g = squareSheet(6, 0.2, 0.05 + kLayer_m + gap);
  for (Vec3& x : g.patches[0].points) x -= Vec3{0.1, 0.1, 0};
  const Vec3 gravity = 9.81 * normalized(Vec3{slope, 0, -1});
  return Motion(g, {gravity, drag}, {kLayer_m, friction, 0.01, 1e-4}, {},
                {{testing_shapes::box({0.5, 0.5, 0.05}), "box"}});
}

double fastest(const Motion& m) {
  double most = 0;
  for (const Vec3& v : m.state.v) most = std::max(most, norm(v));
  return most;
}

TEST(Pressing, ClothAtRestHasNoVelocityAndFeelsNoDrag) {
  for (double slope : {0.0, 0.2}) {  // 0.2: friction 0.3 holds it
    Motion m = sheetOnBox(50, slope, 0);
    double carried = 0, weight = 0, drag = 0, worst = 0;
    for (int s = 0; s < 2000; ++s) {
      const StepReport r = m.step(kStep_s);
      ASSERT_EQ(r.failure, StepFailure::none) << r.why;
      worst = std::max(worst, r.momentum.error() / r.momentum.scale);
      if (s < 1500) continue;
      carried += norm(r.momentum.obstacles);
      weight += norm(r.momentum.gravity);
      drag -= r.work.drag;
    }
    std::printf("[ measured ] slope %.1f: %.6f of the weight, %.3g of g dt, drag took %.3g J\n", slope,
                carried / weight, fastest(m) / (9.81 * kStep_s), drag);
    EXPECT_NEAR(carried / weight, 1, 1e-4);        // 0.967 where the velocity is half a step's fall
    EXPECT_LT(fastest(m), 1e-3 * 9.81 * kStep_s);  // 0.5
    EXPECT_LT(drag, 1e-12);
    EXPECT_LT(worst, 1e-12);
  }
}

/// What the velocity holds in advance is taken out again: taking it out by hand changes nothing but rounding where
/// there is no drag.
TEST(Pressing, PathsAreTheSameWithoutDrag) {
  Motion with = sheetOnBox(0, 0.5, 0.5e-3), without = sheetOnBox(0, 0.5, 0.5e-3);
  bool pressed = false;
  for (int s = 0; s < 200; ++s) {
    ASSERT_EQ(with.step(kStep_s).failure, StepFailure::none);
    ASSERT_EQ(without.step(kStep_s).failure, StepFailure::none);
    pressed = pressed || !without.state.pressed.empty();
    for (std::size_t i = 0; i < without.state.pressed.size(); ++i)
      without.state.v[i] -= 0.5 * kStep_s * without.state.pressed[i];
    without.state.pressed.clear();
  }
  EXPECT_TRUE(pressed);
  double most = 0;
  for (std::size_t i = 0; i < with.state.p.size(); ++i)
    most = std::max(most, norm(with.state.p[i] - without.state.p[i]));
  EXPECT_LT(most, 1e-9);
}

/// An impact changes the velocity at once: no half of it is held in advance, with which the sheet would seem to rise.
TEST(Pressing, AnImpactIsNoForce) {
  Motion m = sheetOnBox(0, 0, 5e-3, 0);
  for (Vec3& v : m.state.v) v.z = -1;
  m.restart();
  double fastest_up = 0;
  bool landed = false;
  for (int s = 0; s < 100; ++s) {
    const StepReport r = m.step(kStep_s);
    ASSERT_EQ(r.failure, StepFailure::none) << r.why;
    landed = landed || norm(r.momentum.obstacles) > 0.5 * norm(r.momentum.gravity) * 100;
    for (const Vec3& v : m.state.v) fastest_up = std::max(fastest_up, v.z);
  }
  EXPECT_TRUE(landed);
  std::printf("[ measured ] up with %.3g g dt after landing at 1 m/s\n", fastest_up / (9.81 * kStep_s));
  EXPECT_LT(fastest_up, 2 * 9.81 * kStep_s);
}

/// The energy's audit closes on cloth that is pressed: what is at rest has no kinetic energy, and nothing works on it.
TEST(Pressing, TheEnergyBalanceClosesAtRest) {
  Motion m = sheetOnBox(20, 0, 0);
  double works = 0, mass = 0;
  Energy before;
  for (int s = 0; s < 500; ++s) {
    const StepReport r = m.step(kStep_s);
    if (s < 50) before = m.energy();  // until then nothing is known to press
    if (s >= 50) works += r.work.contact + r.work.drag;
  }
  for (double one : m.model->mass_kg) mass += one;
  const Energy after = m.energy();
  const double half_a_fall = 0.5 * mass * norm2(0.5 * kStep_s * m.model->environment.gravity_m_per_s2);
  std::printf("[ measured ] change %.3g J, works %.3g J, kinetic %.3g J; of half a step's fall %.3g J\n",
              after.total() - before.total(), works, after.kinetic, half_a_fall);
  EXPECT_NEAR(after.total() - before.total(), works, 0.01 * half_a_fall);
  EXPECT_LT(after.kinetic, 0.01 * half_a_fall);
}

/// The audit knows what velocities hold in advance, and shows where it is wrong.
TEST(Pressing, AWrongTermShows) {
  Motion m = sheetOnBox(1, 0, 0.5e-3);
  StepReport r;
  int steps = 0;
  do r = m.step(kStep_s);
  while (norm(r.momentum.pressing) < 1e-2 * r.momentum.scale && ++steps < 500);
  ASSERT_LT(steps, 500);
  ASSERT_LT(r.momentum.error(), 1e-12 * r.momentum.scale);
  MomentumAudit bad = r.momentum;
  bad.pressing *= 1 + 1e-6;
  EXPECT_GT(bad.error(), 1e-9 * bad.scale);
}

}  // namespace
}  // namespace gambeson
