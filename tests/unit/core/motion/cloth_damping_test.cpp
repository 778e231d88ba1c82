/// Damping by the cloth itself in explicit steps: the balance of energy, the order, and the stable step.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/motion/implicit_velocities.hpp"
#include "core/motion/motion_audit.hpp"
#include "core/motion/runge_kutta.hpp"
#include "unit/core/cloth/triangles/triangle_shapes.hpp"
#include "unit/core/motion/structure_moves.hpp"

namespace gambeson {
namespace {

using namespace shapes;

Fabric cloth() {
  Fabric f;
  f.thickness_m = 5e-4;
  f.density_kg_per_m3 = 400;
  f.young_weft_Pa = f.young_warp_Pa = 2e6;
  f.shear_Pa = 1e6;
  f.law = LinearBending{{1e-6, 1e-6, 1e-6}};
  return f;
}

MembraneModel damped(MembraneElements elements, double coefficient) {
  MembraneModel m;
  m.elements = elements;
  m.stretch_damping_Ns_per_m = coefficient;
  m.shear_damping_Ns_per_m = elements == MembraneElements::springs ? 0 : 0.5 * coefficient;
  return m;
}

/// A free sheet that is stretched, and moves.
struct Sheet {
  std::unique_ptr<Model> model;
  EmptyStage stage;
  StepWork work;
  State state, next;

  explicit Sheet(const MembraneModel& m, double amplitude = 1e-4) {
    ModelOptions o;
    o.self_contact = false;
    MeshDraft g = flatTriangles(6, 5, 0.3, 0.25, cloth(), MeshKind::single, 0.2);
    g.membrane = m;
    std::vector<MeshDraft> all{g};
    model = buildModel(std::make_unique<TriangleCloth>(std::move(all)), o, {Vec3{}, 0}, {}, {});
    state = initialState(*model, stage, 0, work);
    for (Vec3& x : state.p) x = x + amplitude * Vec3{std::sin(9 * x.x), std::cos(7 * x.y), std::sin(8 * x.x + 3 * x.y)};
    for (std::size_t i = 0; i < state.v.size(); ++i) {
      const Vec3& x = state.p[i];
      state.v[i] = Vec3{0.03, -0.02, 0.05} + 2000 * amplitude * Vec3{std::sin(11 * x.y), std::sin(9 * x.x), 0};
    }
    attachSprings(*model, stage, state, work);
  }

  StepReport step(double dt) {
    const StepReport r = gambeson::step(*model, stage, state, dt, next, work);
    std::swap(state, next);
    return r;
  }
  double energy() { return energyOf(*model, stage, state, work).total(); }
};

// Energy and what damping took of it: the gap falls with the square of the step. Momentum stays in every step.
TEST(ClothDamping, TakesWhatTheEnergyLoses) {
  for (const MembraneElements elements : {MembraneElements::springs, MembraneElements::baraff_witkin}) {
    double gap[3], taken[3];
    for (int k = 0; k < 3; ++k) {
      Sheet s(damped(elements, 0.2));
      const double first = s.energy(), dt = 4e-5 / (1 << k);
      double lost = 0, dissipated = 0;
      for (int i = 0; i < 100 << k; ++i) {
        const StepReport r = s.step(dt);
        ASSERT_EQ(r.failure, StepFailure::none);
        EXPECT_LT(r.momentum.error(), 1e-9 * r.momentum.scale);
        EXPECT_GE(r.work.dissipated, 0);
        lost += r.work.cloth;
        dissipated += r.work.dissipated;
      }
      gap[k] = s.energy() + lost - first;
      taken[k] = lost;
      EXPECT_GT(lost, 0.05 * first);
      EXPECT_NEAR(dissipated / lost, 1, 0.2);
    }
    std::printf("[ measured ] lost %.5g J; gap %.3g, %.3g, %.3g of it\n", taken[2], gap[0] / taken[0],
                gap[1] / taken[1], gap[2] / taken[2]);
    EXPECT_LT(std::abs(gap[2]), 2e-3 * taken[2]);
    EXPECT_GT(std::abs(gap[0] / gap[1]), 3.3);
    EXPECT_GT(std::abs(gap[1] / gap[2]), 3.3);
  }
}

// Every scheme damps alike: the same motion and the same loss, to its own order; momentum stays in every step.
TEST(ClothDamping, IsOfAllSchemes) {
  for (const MembraneElements elements : {MembraneElements::springs, MembraneElements::baraff_witkin}) {
    const MembraneModel m = damped(elements, 0.2);
    Sheet exact(m);
    double lost = 0;
    for (int i = 0; i < 3200; ++i) lost += exact.step(4e-5 / 32).work.cloth;
    const std::vector<Vec3> start = Sheet(m).state.p;
    double way = 0;
    for (std::size_t i = 0; i < start.size(); ++i) way = std::max(way, norm(exact.state.p[i] - start[i]));
    const auto expectAlike = [&](FreeScheme& scheme, const char* name, double dt, double off) {
      Sheet s(m);
      FreeMotion free;
      double taken = 0, worst = 0;
      for (int i = 0; i < static_cast<int>(std::round(4e-3 / dt)); ++i) {
        const StepReport r = freeStep(*s.model, s.stage, scheme, s.state, dt, s.next, free, s.work);
        ASSERT_EQ(r.failure, StepFailure::none) << r.why;
        EXPECT_LT(r.momentum.error(), 1e-9 * r.momentum.scale) << name;
        EXPECT_GT(r.work.cloth, 0) << name;
        taken += r.work.cloth;
        std::swap(s.state, s.next);
      }
      for (std::size_t i = 0; i < start.size(); ++i) worst = std::max(worst, norm(s.state.p[i] - exact.state.p[i]));
      std::printf("[ measured ] %s: loss %.4f of Verlet's, %.2g of the way off\n", name, taken / lost, worst / way);
      EXPECT_NEAR(taken / lost, 1, off) << name;
      EXPECT_LT(worst, off * way) << name;
    };
    RungeKutta fourth(RungeKuttaOrder::fourth), midpoint(RungeKuttaOrder::midpoint), euler(RungeKuttaOrder::euler);
    expectAlike(fourth, "RK4", 4e-5, 0.01);
    expectAlike(midpoint, "RK2", 2e-5, 0.02);
    expectAlike(euler, "Euler", 1e-6, 0.05);
    ImplicitVelocities implicit({0, 1e-10}), semi({2, 1e-10});
    expectAlike(implicit, "implicit Euler", 1e-6, 0.05);
    expectAlike(semi, "semi-implicit", 1e-6, 0.05);
  }
}

// The force has the velocity of the half step: of first order in the step, where undamped motion is of second.
TEST(ClothDamping, IsOfFirstOrderInVerlet) {
  const auto end = [](double coefficient, double dt, int steps) {
    Sheet s(damped(MembraneElements::springs, coefficient));
    for (int i = 0; i < steps; ++i) s.step(dt);
    return s.state.p;
  };
  for (const double coefficient : {0.0, 0.2}) {
    double error[2];
    const std::vector<Vec3> exact = end(coefficient, 1e-5 / 16, 1600);
    for (int k = 0; k < 2; ++k) {
      const std::vector<Vec3> p = end(coefficient, 1e-5 / (1 << k), 100 << k);
      error[k] = 0;
      for (std::size_t i = 0; i < p.size(); ++i) error[k] = std::max(error[k], norm(p[i] - exact[i]));
    }
    const double order = std::log2(error[0] / error[1]);
    std::printf("[ measured ] damping %g: order %.3f\n", coefficient, order);
    EXPECT_NEAR(order, coefficient > 0 ? 1.05 : 2, 0.15);
  }
}

/// The largest energy of a small perturbation over the steps, relative to the first.
double growth(const MembraneModel& m, double factor, int steps, double* omega) {
  Sheet s(m, 0);
  Frequency f = largestFrequency(*s.model, s.stage, s.state, 60, s.work);
  *omega = f.largest_rad_per_s;
  EXPECT_STREQ(f.governing(), "membrane");
  EXPECT_NEAR(f.membrane_share + f.bending_share + f.seam_share + f.spring_share, 1, 1e-4);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> d(-1e-9, 1e-9);
  for (Vec3& x : s.state.p) x += Vec3{d(random), d(random), d(random)};
  for (Vec3& v : s.state.v) v = {};
  attachSprings(*s.model, s.stage, s.state, s.work);
  const double first = s.energy(), dt = factor * 2 / f.largest_rad_per_s;
  double most = 1;
  for (int k = 0; k < steps && most < 1e6; ++k) {
    EXPECT_EQ(s.step(dt).failure, StepFailure::none);
    most = std::max(most, s.energy() / first);
  }
  return most;
}

// w h < 2 (sqrt(1 + z^2) - z): stable at 0.98 of it, and not at 1.04; undamped, weakly and strongly damped.
TEST(ClothDamping, TheStableStepAllowsForIt) {
  for (const MembraneElements elements : {MembraneElements::springs, MembraneElements::baraff_witkin}) {
    double undamped = 0, omega = 0;
    for (const double coefficient : {0.0, 0.02, 0.2, 5.0}) {
      EXPECT_LT(growth(damped(elements, coefficient), 0.98, 2000, &omega), 30);
      EXPECT_GT(growth(damped(elements, coefficient), 1.04, 2000, &omega), 1e3);
      if (coefficient == 0) undamped = omega;
      std::printf("[ measured ] damping %g: step %.4g of the undamped one\n", coefficient, undamped / omega);
    }
    EXPECT_GT(omega, 5 * undamped);
  }
}

// Of one mode with the damping z, the step is that of the closed form: two points and a spring, seen in the largest
// frequency of a sheet whose damping goes with its stiffness, z = w tau/2.
TEST(ClothDamping, TheStableStepIsThatOfTheClosedForm) {
  MembraneModel m = damped(MembraneElements::springs, 0);
  m.spring_N_per_m = 1000;
  Sheet plain(m, 0);
  const double w = largestFrequency(*plain.model, plain.stage, plain.state, 80, plain.work).largest_rad_per_s;
  for (const double tau : {1e-5, 1e-4, 1e-3}) {
    m.stretch_damping_Ns_per_m = tau * m.spring_N_per_m;
    Sheet s(m, 0);
    const double ours = largestFrequency(*s.model, s.stage, s.state, 80, s.work).largest_rad_per_s, z = 0.5 * w * tau;
    EXPECT_NEAR(2 / ours / (2 * (std::sqrt(1 + z * z) - z) / w), 1, 2e-3);
  }
}

// A structure that is let go, by Verlet and by Newmark's rule: both come to the same place, and close their balances.
TEST(ClothDamping, ImplicitStepsDampAlike) {
  for (const MembraneElements elements : {MembraneElements::springs, MembraneElements::baraff_witkin}) {
    MeshDraft g = flatTriangles(4, 3, 0.3, 0.25, cloth(), MeshKind::single, 0.2);
    g.membrane = damped(elements, 0.2);
    const auto s = buildStructure(std::make_shared<TriangleCloth>(std::vector{g}), StructureOptions{});
    std::vector<double> y(static_cast<std::size_t>(s->dofs.unknowns()));
    for (std::size_t i = 0; i < y.size(); ++i)  // in the plane
      if (s->dofs.component[i] % 3 != 2) y[i] = 1e-4 * std::sin(1.7 * static_cast<double>(i));
    constexpr double end_s = 2e-3;
    ExplicitSteps verlet(*s, {}, y);
    MotionAudit of_verlet(*s, true), of_newmark(*s, true);
    verlet.run(end_s, 2e-6,
               [&](const State& before, const State& now, const StepReport& r) { of_verlet.observe(before, now, r); });
    State state = structureState(*s, 0, y, {}, {});
    const Watch watch = [&](const State&, const State& now, const StepReport& r) {
      of_newmark.observe(now, r.work.cloth);
    };
    ImplicitSteps(*s, {.scheme = ImplicitScheme::newmark, .step_s = 1e-5, .tolerance = 1e-10, .lumped_mass = true})
        .advance(end_s, state, observerOf(watch));
    double apart = 0, moved = 0;
    for (std::size_t i = 0; i < state.p.size(); ++i) {
      apart = std::max(apart, norm(state.p[i] - verlet.state.p[i]));
      moved = std::max(moved, norm(state.p[i] - s->cloth->rest()[static_cast<std::size_t>(s->cloth->map().home[i])]));
    }
    EXPECT_LT(apart, 0.02 * moved);
    EXPECT_LT(of_verlet.largestEnergyGap(), 1e-3 * of_verlet.works());
    EXPECT_LT(of_newmark.largestEnergyGap(), 1e-2 * of_newmark.works());
    EXPECT_LT(of_verlet.largestMomentumGap(), 1e-12);
  }
}

// A sheet that turns as one loses nothing to its damping in implicit steps, which end elsewhere than where they began.
TEST(ClothDamping, ImplicitStepsLetASheetTurn) {
  for (const MembraneElements elements : {MembraneElements::springs, MembraneElements::baraff_witkin}) {
    MeshDraft g = flatTriangles(3, 2, 0.3, 0.25, cloth(), MeshKind::single, 0.2);
    g.membrane = damped(elements, 0.2);
    const auto s = buildStructure(std::make_shared<TriangleCloth>(std::vector{g}), StructureOptions{});
    State state = structureState(*s, 0, {}, {}, {});
    Vec3 middle{};
    double mass = 0;
    for (std::size_t i = 0; i < state.p.size(); ++i) middle += s->lumped_kg[i] * state.p[i], mass += s->lumped_kg[i];
    const Vec3 w{1, 2, 6};
    for (std::size_t i = 0; i < state.p.size(); ++i) state.v[i] = cross(w, state.p[i] - middle / mass);
    const double turn_s = 2 * kPi / norm(w);
    ImplicitSteps steps(*s, {.scheme = ImplicitScheme::newmark, .step_s = turn_s / 200, .lumped_mass = true});
    const double start = energyOf(*s, state, true).total();
    steps.advance(turn_s, state, observerOf({}));
    const double first = energyOf(*s, state, true).total();
    steps.advance(6 * turn_s, state, observerOf({}));
    const double end = energyOf(*s, state, true).total();
    std::printf("[ measured ] of a turning sheet damping takes %.2e, after its first turn %.2e\n", 1 - end / start,
                1 - end / first);
    EXPECT_LT(std::abs(1 - end / start), 1e-3);
    EXPECT_LT(std::abs(1 - end / first), 1e-4);
  }
}

}  // namespace
}  // namespace gambeson
