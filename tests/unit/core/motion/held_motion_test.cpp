/// Held points that are moved: they go where they are told, and what that does is in the balances of momentum and
/// energy; and points that are let go.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/error.hpp"
#include "core/motion/held_motion.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

/// Moves by 0.4 m/s^2 t along z and turns about x through the middle of the edge by 6 rad/s^2 t.
class Swing : public UniformStage {
 public:
  static constexpr double kPush = 0.4, kTurn = 6;
  void heldMotions(double t, std::span<HeldMotion> motions) const override {
    const Vec3 centre{0, 0.1, 0}, way{0, 0, 0.5 * kPush * t * t};
    const Mat3 R = rotationAbout({1, 0, 0}, 0.5 * kTurn * t * t);
    motions[0].pose = {R, centre - R * centre + way};
    motions[0].rate = {centre + way, {0, 0, kPush * t}, {kTurn * t, 0, 0}};
  }
};

struct Moved {
  Garment garment = squareSheet(8, 0.2, 0);
  std::unique_ptr<Model> model;
  Swing stage;
  StepWork work;
  State state, next;

  explicit Moved(bool ball) {
    ModelOptions o;
    for (int j = 0; j < garment.patches[0].v.count(); ++j)
      o.held_control_points.push_back(garment.patches[0].index(0, j));
    o.held_motion.assign(o.held_control_points.size(), 0);
    std::vector<Obstacle> obstacles;
    if (ball) {
      obstacles.push_back({Ellipsoid{{0.05, 0.05, 0.05}}, "ball"});
      stage.at = {{{}, {0.15, 0.1, -0.052}, 1}};
      stage.velocity = {{0, 0, 0.3}};
    }
    model = buildModel(garment, o, {{0, 0, -9.81}, 0.2}, {1e-3, 0.3, 0.01, 1e-2, 400}, std::move(obstacles), {});
    state = initialState(*model, stage, 0, work);
  }
  StepReport step(double dt) {
    const StepReport r = gambeson::step(*model, stage, state, dt, next, work);
    std::swap(state, next);
    return r;
  }
  double energy() { return energyOf(*model, stage, state, work).total(); }
};

TEST(HeldMotion, GoesWhereItIsTold) {
  Moved m(false);
  const std::vector<Vec3> start = m.state.p;
  for (int s = 0; s < 1000; ++s) ASSERT_EQ(m.step(2e-4).failure, StepFailure::none);
  std::vector<HeldMotion> motion(1);
  m.stage.heldMotions(m.state.time_s, motion);
  double most = 0, fastest = 0;
  for (const int i : m.model->held_points) {
    most = std::max(most, norm(m.state.p[i] - motion[0].pose * start[i]));
    EXPECT_EQ(m.state.v[i], motion[0].rate.at(m.state.p[i]));
    fastest = std::max(fastest, norm(m.state.v[i]));
  }
  std::printf("[ measured ] off by %.3g m after 1000 steps\n", most);
  EXPECT_LT(most, 1e-13);
  EXPECT_GT(fastest, 0.1);
}

/// Energy changes by the works, those of the supports among them, to second order of the step; momentum in each step.
TEST(HeldMotion, IsInTheBalances) {
  for (const bool ball : {false, true}) {
    double off[2];
    for (int fine = 0; fine < 2; ++fine) {
      Moved m(ball);
      const double first = m.energy(), dt = fine ? 5e-5 : 1e-4;
      double works = 0, supports = 0, contact = 0, worst = 0;
      for (int s = 0; s < (fine ? 6000 : 3000); ++s) {
        const StepReport r = m.step(dt);
        ASSERT_EQ(r.failure, StepFailure::none) << r.why;
        supports += r.work.supports;
        contact += r.work.contact;
        works += r.work.contact + r.work.drag + r.work.supports;
        worst = std::max(worst, r.momentum.error() / r.momentum.scale);
      }
      off[fine] = std::abs(m.energy() - first - works) / std::abs(supports);
      std::printf("[ measured ] ball %d: supports %.4g J, contact %.3g J, energy off by %.3g of that; momentum %.2g\n",
                  ball, supports, contact, off[fine], worst);
      EXPECT_LT(worst, 1e-9);
      EXPECT_GT(supports, 1e-5);
      EXPECT_EQ(contact != 0, ball);
    }
    EXPECT_LT(off[1], 2e-3);
    if (!ball) {
      EXPECT_LT(off[1], 0.35 * off[0]);
    }
  }
}

/// The force of what moves has inertia in it: rigid motion of a whole sheet takes mass times acceleration.
TEST(HeldMotion, OfAllPointsTakesMassTimesAcceleration) {
  Moved m(false);
  ModelOptions o;
  for (int i = 0; i < static_cast<int>(m.garment.patches[0].points.size()); ++i) o.held_control_points.push_back(i);
  o.held_motion.assign(o.held_control_points.size(), 0);
  m.model = buildModel(m.garment, o, {{0, 0, -9.81}, 0}, {1e-3, 0.3, 0.01, 1e-2, 400}, {}, {});
  m.state = initialState(*m.model, m.stage, 0, m.work);
  const double dt = 1e-3;
  ASSERT_EQ(m.step(dt).failure, StepFailure::none);
  Vec3 impulse{};
  double mass = 0;
  for (const Vec3& i : m.work.held_impulses) impulse += i;
  for (const double one : m.model->mass_kg) mass += one;
  EXPECT_NEAR(impulse.z, mass * (Swing::kPush + 9.81) * dt, 1e-9 * mass * dt);
}

/// What is let go falls as if it had never been held, and the balances go on.
TEST(HeldMotion, EndsWhereItIsLetGo) {
  Moved m(false);
  for (int s = 0; s < 200; ++s) ASSERT_EQ(m.step(2e-4).failure, StepFailure::none);
  holdOnly({}, *m.model);
  EXPECT_TRUE(m.model->held_points.empty());
  evaluateForces(*m.model, m.stage, m.state, m.work);
  const double first = m.energy();
  double works = 0, worst = 0;
  for (int s = 0; s < 1000; ++s) {
    const StepReport r = m.step(1e-4);
    ASSERT_EQ(r.failure, StepFailure::none);
    works += r.work.drag + r.work.supports;
    worst = std::max(worst, r.momentum.error() / r.momentum.scale);
    EXPECT_EQ(r.work.supports, 0);
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_NEAR(m.energy() - first, works, 1e-3 * std::abs(works));
}

TEST(HeldMotion, OfOnePointIsOne) {
  const Garment g = squareSheet(4, 0.2, 0);
  ModelOptions o;
  o.held_control_points = {0, 1, 0};
  o.held_motion = {0, 0, 1};
  EXPECT_THROW(buildModel(g, o, {{0, 0, 0}, 0}, {}, {}, {}), InputError);
  o.held_motion = {0, 1, 0};
  EXPECT_NO_THROW(buildModel(g, o, {{0, 0, 0}, 0}, {}, {}, {}));
}

}  // namespace
}  // namespace gambeson
