/// Contact of structures: the same motion as that of worn cloth, and supports that hold components, couple points or
/// move while the sheet lies on a body.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "core/cloth/patches/patch_loads.hpp"
#include "core/cloth/patches/patch_supports.hpp"
#include "core/motion/implicit_velocities.hpp"
#include "core/motion/motion_audit.hpp"
#include "core/motion/runge_kutta.hpp"
#include "unit/core/motion/motion_shapes.hpp"
#include "unit/core/motion/structure_moves.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const std::vector<Vec3> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Vec3 gravity{0, 0, -9.81};
constexpr double kSide_m = 0.3;
const ContactParameters kContact{0, 0.3, 0.01};

/// A sheet above a ball whose top is 2 mm below the middle of it.
Garment sheetAboveBall() {
  Garment g = squareSheet(10, kSide_m, 0);
  for (Vec3& x : g.patches[0].points) x -= Vec3{kSide_m / 2, kSide_m / 2, 0};
  return g;
}
std::vector<Obstacle> ball() { return {{Ellipsoid{{0.08, 0.08, 0.08}}, "ball"}}; }
Placement ballAt() {
  Placement at;
  at.origin = {0, 0, -0.08 - 0.0035};
  return at;
}

StructureOptions falling(const Garment& g) {
  StructureOptions o;
  o.programs = {{{0}, {1}}};
  o.dead = {{weightForce(g, gravity), 0}};
  o.drag_kg_per_m2s = 0.3;
  return o;
}

/// Explicit steps of a structure above the ball, with everything that is checked of each.
struct OnBall {
  std::unique_ptr<Structure> structure;
  std::unique_ptr<Model> model;
  UniformStage stage;
  StepWork work;
  State state, next;
  double deepest_m = 0, momentum = 0, energy = 0;
  int touching = 0;
  Vec3 on_ball_Ns;

  OnBall(const Garment& g, const StructureOptions& so, const StrainLimit& limit = {}) {
    structure = buildStructure(g, so);
    ModelOptions o;
    o.structure = structure.get();
    o.strain_limit = limit;
    model = buildModel(structure->cloth, o, {Vec3{}, 0}, kContact, ball());
    stage.at = {ballAt()};
    stage.velocity = {{}};
    state = initialState(*model, stage, 0, work);
  }

  /// `scheme`: null for velocity Verlet.
  void run(double dt, int count, FreeScheme* scheme = nullptr) {
    MotionAudit audit(*structure, true);
    FreeMotion free;
    for (int k = 0; k < count; ++k) {
      const StepReport r = scheme ? freeStep(*model, stage, *scheme, state, dt, next, free, work)
                                  : step(*model, stage, state, dt, next, work);
      ASSERT_EQ(r.failure, StepFailure::none) << k << ": " << r.why;
      audit.observe(state, next, r);
      deepest_m = std::max(deepest_m, r.deepest_m);
      momentum = std::max(momentum, r.momentum.error() / r.momentum.scale);
      touching += r.contacts > 0;
      on_ball_Ns += r.momentum.obstacles;
      std::swap(state, next);
    }
    energy = audit.largestEnergyGap() / audit.works();
  }

  void expectSupported(const StructureOptions& so) const {
    const std::vector<Vec3> q = controlPoints(*structure, state);
    for (const LinearConstraint& l : so.constraints) {
      double sum = 0;
      for (const auto& [control, coefficient] : l.terms)
        sum += dot(coefficient, q[control] - structure->cloth->rest()[control]);
      EXPECT_NEAR(sum, l.program < 0 ? 0 : l.amount_m * so.programs[l.program](state.time_s), 1e-12);
    }
  }
};

/// Held at one edge: both ways of holding it, step for step.
TEST(StructureContact, MovesAsWornCloth) {
  const Garment g = sheetAboveBall();
  const double dt = 4e-4;
  const int count = 400;
  ModelOptions worn;
  for (int j = 0; j < g.patches[0].v.count(); ++j) worn.held_control_points.push_back(g.patches[0].index(0, j));
  Motion m(g, {gravity, 0.3}, kContact, worn, ball(), {ballAt()});
  for (int s = 0; s < count; ++s) ASSERT_EQ(m.step(dt).failure, StepFailure::none);
  StructureOptions o = falling(g);
  o.constraints = supportEdge(g, {0, Side::u0}, axes);
  OnBall s(g, o);
  s.run(dt, count);
  double apart = 0;
  for (std::size_t k = 0; k < s.state.p.size(); ++k) apart = std::max(apart, norm(s.state.p[k] - m.state.p[k]));
  std::printf("[ measured ] apart %.2g m, %d steps in contact\n", apart, s.touching);
  EXPECT_LT(apart, 1e-7);  // rounding, through 400 steps of stick and slip
  EXPECT_GT(s.touching, 300);
}

/// Rollers at one edge (components), a bar that ties the points of another, and a point inside of a cell: the sheet
/// lies on the ball, supports hold to rounding, momentum is the ledger's, and what contact and supports do is all of
/// the energy.
TEST(StructureContact, SupportsHoldComponentsAndTiesWhileItTouches) {
  const Garment g = sheetAboveBall();
  for (const bool bar : {false, true})
    for (const LimitMode mode : {LimitMode::none, LimitMode::equality, LimitMode::upper_limit}) {
      SCOPED_TRACE(testing::Message() << (bar ? "bar" : "rollers") << ", limit " << static_cast<int>(mode));
      StructureOptions o = falling(g);
      if (bar) {
        for (const Vec3& axis : axes)
          for (LinearConstraint& l : tieEdge(g, {0, Side::v0}, axis)) o.constraints.push_back(std::move(l));
        for (LinearConstraint& l : supportPoint(g, 0, {0.37, 0.81}, axes)) o.constraints.push_back(std::move(l));
      } else {
        o.constraints = supportEdge(g, {0, Side::v1}, std::vector<Vec3>{axes[1], axes[2]});
        for (LinearConstraint& l : supportPoint(g, 0, {0, 1}, axes)) o.constraints.push_back(std::move(l));
      }
      StrainLimit limit;
      if (mode != LimitMode::none) {
        limit = {mode, mode == LimitMode::upper_limit ? 0.002 : 0, 1e-3};
        limit.stiffness_N_per_m = 5e4;
      }
      OnBall s(g, o, limit);
      s.run(2.5e-4, 400);
      s.expectSupported(o);
      std::printf("[ measured ] deepest %.2g mm, momentum %.2g, energy %.2g, %d steps in contact\n", 1e3 * s.deepest_m,
                  s.momentum, s.energy, s.touching);
      EXPECT_LT(s.deepest_m, 1e-6);
      EXPECT_LT(s.momentum, 1e-9);
      EXPECT_LT(s.energy, 0.02);
      EXPECT_GT(s.touching, 300);
      EXPECT_LT(s.on_ball_Ns.z, -0.002) << "the ball bears part of it";
    }
}

/// An edge that a program lifts draws the sheet over the ball.
TEST(StructureContact, SupportsMoveWhileItTouches) {
  const Garment g = sheetAboveBall();
  StructureOptions o = falling(g);
  o.programs.push_back({{0, 0.1, 0.2}, {0, 0, 1}});
  o.constraints = supportEdge(g, {0, Side::u0}, axes, {{-0.05, 0, 0.05}, 1});
  OnBall s(g, o);
  s.run(2.5e-4, 800);
  s.expectSupported(o);
  std::printf("[ measured ] deepest %.2g mm, momentum %.2g, energy %.2g\n", 1e3 * s.deepest_m, s.momentum, s.energy);
  EXPECT_LT(s.deepest_m, 1e-6);
  EXPECT_LT(s.momentum, 1e-9);
  EXPECT_LT(s.energy, 0.02);
}

/// Rollers, ties and an edge that moves in a slanting direction, under each of the other schemes: supports hold,
/// momentum is the ledger's, and works and what the scheme itself makes or takes are all of the energy.
TEST(StructureContact, EverySchemeMovesUnderSupports) {
  const Garment g = sheetAboveBall();
  for (int supports = 0; supports < 3; ++supports)
    for (int which = 0; which < 4; ++which) {
      SCOPED_TRACE(testing::Message() << "supports " << supports << ", scheme " << which);
      StructureOptions o = falling(g);
      if (supports == 0) {
        o.constraints = supportEdge(g, {0, Side::v1}, std::vector<Vec3>{axes[1], axes[2]});
        for (LinearConstraint& l : supportPoint(g, 0, {0, 1}, axes)) o.constraints.push_back(std::move(l));
      } else if (supports == 1) {
        for (const Vec3& axis : axes)
          for (LinearConstraint& l : tieEdge(g, {0, Side::v0}, axis)) o.constraints.push_back(std::move(l));
        for (LinearConstraint& l : supportPoint(g, 0, {0.37, 0.81}, axes)) o.constraints.push_back(std::move(l));
      } else {
        o.programs.push_back({{0, 0.02, 0.1}, {0, 0, 1}});
        const Vec3 slant = normalized(Vec3{1, 0, 2});
        o.constraints = supportEdge(g, {0, Side::u0}, std::vector<Vec3>{slant, axes[1]}, {0.02 * slant, 1});
      }
      RungeKutta midpoint(RungeKuttaOrder::midpoint), fourth(RungeKuttaOrder::fourth);
      ImplicitVelocities euler({0, 1e-6}), split({4, 1e-6});
      FreeScheme* schemes[] = {&midpoint, &fourth, &euler, &split};
      const double dt[] = {1e-4, 2.5e-4, 1e-3, 1e-3};
      OnBall s(g, o);
      s.run(dt[which], static_cast<int>(0.1 / dt[which]), schemes[which]);
      s.expectSupported(o);
      EXPECT_LT(s.deepest_m, 1e-6);
      EXPECT_LT(s.momentum, 1e-9);
      EXPECT_LT(s.energy, 1e-6);
      EXPECT_GT(s.touching, 10);
    }
}

}  // namespace
}  // namespace gambeson
