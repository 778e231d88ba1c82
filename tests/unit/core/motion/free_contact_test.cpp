/// The schemes beside velocity Verlet in contact: momentum in every step, energy over the run, the same bits for any
/// number of threads.

#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "core/motion/free_steps.hpp"
#include "unit/core/motion/motion_shapes.hpp"

namespace gambeson {
namespace {

using namespace shapes;

struct Case {
  MotionScheme scheme;
  double step_s;
  int substeps = 1;
};
constexpr Case kCases[] = {{MotionScheme::verlet, 3e-4},           {MotionScheme::euler, 5e-6},
                           {MotionScheme::symplectic_euler, 3e-4}, {MotionScheme::midpoint, 5e-5},
                           {MotionScheme::runge_kutta, 3e-4},      {MotionScheme::implicit_euler, 1e-3},
                           {MotionScheme::semi_implicit, 1e-3, 1}, {MotionScheme::semi_implicit, 2e-3, 4}};

/// A sheet held along an edge, hung on springs at two corners, in the wind, over a rising ball that it touches.
Motion everything() {
  const Garment g = squareSheet(6, 0.2, 0);
  ModelOptions o;
  for (int j = 0; j < g.patches[0].v.count(); ++j) o.held_control_points.push_back(g.patches[0].index(0, j));
  o.anchor_count = 1;
  o.springs = {{12, 0, 0.5}, {162, 0, 0.5}};
  Motion m(g, {{0, 0, -9.81}, 0.5}, {1e-3, 0.3, 0.01, 1e-2, 400}, o, {{Ellipsoid{{0.05, 0.05, 0.05}}, "ball"}},
           {{{}, {0.1, 0.1, -0.06}, 1}}, {{0, 0.1, 0.3}});
  m.stage.wind = {0.5, 1, 0};
  m.restart();
  return m;
}

struct Balance {
  double momentum = 0, works = 0, gap_J = 0, made_J = 0;
  long contacts = 0;
};

Balance follow(Motion& m, const Case& c, double end_s, double tolerance = 1e-6) {
  Balance b;
  StepControl control;
  control.fixed_s = c.step_s;
  control.audits_energy = true;
  Frequency f;
  const auto total = [&](const State& s) { return energyOf(*m.model, m.stage, s, m.work).total(); };
  StepWork apart;
  const double start = energyOf(*m.model, m.stage, m.state, apart).total();
  double works = 0;
  makeIntegrator({c.scheme, c.substeps, tolerance}, *m.model, m.stage, control, f, m.work)
      ->advance(end_s, m.state,
                [&](const State&, const State&, const StepReport& r, const StepResult& w, const Frequency&) {
                  b.momentum = std::max(b.momentum, r.momentum.error() / r.momentum.scale);
                  b.contacts += static_cast<long>(w.contact_impulses.size());
                  const WorkAudit& k = r.work;
                  works += k.contact + k.drag + k.supports + k.integrator - k.cloth;
                  b.works += std::abs(k.contact) + std::abs(k.drag) + std::abs(k.supports);
                  b.made_J += k.integrator;
                });
  b.gap_J = total(m.state) - start - works;
  return b;
}

TEST(FreeContact, MomentumAndEnergyClose) {
  for (const Case& c : kCases) {
    Motion m = everything();
    const Balance b = follow(m, c, c.scheme == MotionScheme::euler ? 0.06 : 0.15);
    const std::string name = std::to_string(static_cast<int>(c.scheme));
    EXPECT_LT(b.momentum, 1e-9) << name;
    EXPECT_GT(b.contacts, 100) << name;
    EXPECT_LT(std::abs(b.gap_J), 1e-6 * b.works) << name;
    // Explicit schemes make little in steps of these lengths; implicit Euler damps, and never makes any.
    if (isImplicit(c.scheme))
      EXPECT_LT(b.made_J, 0) << name;
    else
      EXPECT_LT(std::abs(b.made_J), 0.05 * b.works) << name;
  }
}

/// A loose solve misses impulses, which have a row of their own in the balance of momentum.
TEST(FreeContact, WhatTheSolveMissesIsARow) {
  Motion m = everything();
  double missed = 0;
  StepControl control;
  control.fixed_s = 1e-3;
  Frequency f;
  makeIntegrator({MotionScheme::implicit_euler, 1, 1e-2}, *m.model, m.stage, control, f, m.work)
      ->advance(0.05, m.state,
                [&](const State&, const State&, const StepReport& r, const StepResult&, const Frequency&) {
                  MomentumAudit without = r.momentum;
                  without.missed = {};
                  missed = std::max(missed, without.error() / without.scale);
                  EXPECT_LT(r.momentum.error(), 1e-9 * r.momentum.scale);
                });
  EXPECT_GT(missed, 1e-5);
}

TEST(FreeContact, TheSameBitsForAnyNumberOfThreads) {
  const int before = omp_get_max_threads();
  for (const Case& c : kCases) {
    // As fourth order, in more steps.
    if (c.scheme == MotionScheme::euler || c.scheme == MotionScheme::midpoint) continue;
    std::vector<Vec3> p[2];
    for (int threads : {1, 2}) {
      omp_set_num_threads(threads);
      Motion m = everything();
      follow(m, c, 0.05);
      p[threads - 1] = m.state.p;
      p[threads - 1].insert(p[threads - 1].end(), m.state.v.begin(), m.state.v.end());
    }
    EXPECT_TRUE(p[0] == p[1]) << static_cast<int>(c.scheme);
  }
  omp_set_num_threads(before);
}

}  // namespace
}  // namespace gambeson
