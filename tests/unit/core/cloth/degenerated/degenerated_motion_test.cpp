/// The degenerated shell in motion: momenta and energy of a free plate, the stable step, supports, Newmark.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/error.hpp"
#include "core/statics/modal.hpp"
#include "core/statics/statics.hpp"
#include "core/statics/structure_system.hpp"
#include "unit/core/cloth/degenerated/degenerated_shapes.hpp"
#include "unit/core/motion/structure_moves.hpp"

namespace gambeson {
namespace {

using namespace shapes;

const std::vector<Vec3> kAxes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

/// Cotton of the thesis's set I (section 5.3): E 1.2 MPa, G = E/12, 436 kg/m^3, without contraction.
Fabric cotton(double thickness_m) {
  Fabric f = isotropicSolid(1.2e6, 0, thickness_m, 436);
  f.shear_Pa = 1e5;
  return f;
}

struct Moved {
  std::shared_ptr<DegeneratedShell> cloth;
  std::unique_ptr<Structure> structure;
  Moved(const Garment& g, const DegeneratedOptions& options = {}, StructureOptions o = {})
      : cloth(std::make_shared<DegeneratedShell>(g, options)), structure(buildStructure(cloth, o)) {}
};

Vec3 at(const std::vector<double>& v, std::size_t k) { return {v[3 * k], v[3 * k + 1], v[3 * k + 2]}; }

/// Turns all as one about its middle, with v = w x r and spins w without drilling.
void spinUp(const Moved& m, const Vec3& w, State& state) {
  Vec3 middle{};
  for (const Vec3& x : state.p) middle += x / static_cast<double>(state.p.size());
  for (std::size_t i = 0; i < state.p.size(); ++i) state.v[i] += cross(w, state.p[i] - middle);
  for (std::size_t d = 0; d < m.cloth->directors().rest.size(); ++d) {
    const Vec3 n = at(state.inner, d), spin = w - dot(w, n) * n;
    for (int k = 0; k < 3; ++k) state.inner_rate[3 * d + static_cast<std::size_t>(k)] += spin[k];
  }
}

struct Momenta {
  Vec3 linear, angular;
};
Momenta momentaOf(const Model& m, const State& s) {
  Momenta all;
  for (std::size_t i = 0; i < s.p.size(); ++i) {
    all.linear += m.mass_kg[i] * s.v[i];
    all.angular += m.mass_kg[i] * cross(s.p[i], s.v[i]);
  }
  for (std::size_t k = 0; k < s.inner_rate.size(); k += 3) all.angular += m.inner_mass[k] * at(s.inner_rate, k / 3);
  return all;
}

/// 2 over the largest frequency of K and M as they are, drilling left out.
double denseStep(const Moved& m) {
  StructureSystem system(*m.structure, ProgramEnds::constant);
  SymmetricMatrix K = system.sparsity(), M = K;
  system.stiffness(system.start(), 0, K);
  system.mass(true, M);
  const int n = system.size();
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd root(n);
  for (int c = 0; c < n; ++c)
    root(c) = 1 / std::sqrt(M.values[static_cast<std::size_t>(M.offsets[static_cast<std::size_t>(c)])]);
  for (int c = 0; c < n; ++c)
    for (int k = K.offsets[static_cast<std::size_t>(c)]; k < K.offsets[static_cast<std::size_t>(c) + 1]; ++k) {
      const int r = K.rows[static_cast<std::size_t>(k)];
      A(r, c) = A(c, r) = K.values[static_cast<std::size_t>(k)] * root(r) * root(c);
    }
  // Flat and at rest: the spin about z is the drilling one.
  for (int j = 0; j < n; ++j) {
    const int inner = m.structure->dofs.component[static_cast<std::size_t>(j)] - 3 * m.structure->dofs.points;
    if (inner >= 0 && inner % 3 == 2) A.row(j).setZero(), A.col(j).setZero();
  }
  return 2 / std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(A, Eigen::EigenvaluesOnly).eigenvalues()(n - 1));
}

TEST(DegeneratedMotion, FreePlateTumblesWithItsMomentaAndItsEnergy) {
  const double t = 1e-3;
  const Moved m(flatSheet(4, 4, 0.1, 0.1, cotton(t)));
  ExplicitSteps moving(*m.structure);
  for (std::size_t i = 0; i < moving.state.p.size(); ++i)
    moving.state.v[i].z += 0.3 * std::sin(60 * moving.state.p[i].x) * std::cos(45 * moving.state.p[i].y);
  spinUp(m, {12, 7, 3}, moving.state);
  attachSprings(*moving.model, moving.stage, moving.state, moving.work);
  const Momenta start = momentaOf(*moving.model, moving.state);
  const double energy = energyOf(*moving.model, moving.stage, moving.state, moving.work).total();
  double mass = 0, worst = 0, longest = 0;
  for (const double own : moving.model->mass_kg) mass += own;
  const double step = 0.8 * denseStep(m);
  int steps = 0;
  moving.run(30000 * step, step, [&](const State&, const State& now, const StepReport&) {
    if (++steps % 100 != 0) return;
    State copy = now;
    worst = std::max(worst, std::abs(energyOf(*moving.model, moving.stage, copy, moving.work).total() / energy - 1));
    for (std::size_t k = 0; k < now.inner.size() / 3; ++k) {
      longest = std::max(longest, std::abs(norm(at(now.inner, k)) - 1));
      longest = std::max(longest, std::abs(dot(at(now.inner, k), at(now.inner_rate, k))) / norm(at(now.inner_rate, k)));
    }
  });
  const Momenta end = momentaOf(*moving.model, moving.state);
  EXPECT_GE(steps, 30000);
  printf("[ measured ] tumbling: %d steps of %.3e s, linear %.2e, angular %.2e, energy %.2e, directors %.2e\n", steps,
         step, norm(end.linear - start.linear) / mass, norm(end.angular - start.angular) / norm(start.angular), worst,
         longest);
  EXPECT_LT(norm(end.linear - start.linear), 1e-11 * mass);
  EXPECT_LT(norm(end.angular - start.angular), 1e-11 * norm(start.angular));
  EXPECT_LT(worst, 1e-4);
  EXPECT_LT(longest, 1e-9);
}

TEST(DegeneratedMotion, AutomaticStepIsThatOfTheLargestFrequency) {
  // Cells of the sleeve's mesh: 30 around a circumference of 2 pi 60 mm, 39 along 0.5 m.
  const double h1 = 2 * kPi * 0.06 / 30, h2 = 0.5 / 39;
  for (const RotaryInertia rotary : {RotaryInertia::exact, RotaryInertia::cell}) {
    const Moved m(flatSheet(6, 6, 6 * h1, 6 * h2, cotton(1e-3)), {ShellRule::mitc4, 5.0 / 6, rotary});
    const double dense = denseStep(m);
    EXPECT_NEAR(dense, rotary == RotaryInertia::exact ? 4.17e-5 : 2.39e-4,
                rotary == RotaryInertia::exact ? 3e-7 : 2e-6);
    ExplicitSteps moving(*m.structure);
    for (std::size_t i = 0; i < moving.state.v.size(); ++i)
      moving.state.v[i].z = 1e-3 * std::sin(40 * moving.state.p[i].x);
    double taken = 0;
    moving.run(100 * dense, 0,
               [&](const State&, const State&, const StepReport& r) { taken = std::max(taken, r.step_s); });
    printf("[ measured ] dense %.4e s, taken %.4e s (%.3f)\n", dense, taken, taken / dense);
    EXPECT_GT(taken, 0.85 * dense);
    EXPECT_LE(taken, dense);
    // And sharp: of a small perturbation the energy grows beyond it, and does not below.
    for (const double factor : {0.95, 1.1}) {
      ExplicitSteps near(*m.structure);
      std::mt19937 random(17);
      std::uniform_real_distribution<double> d(-1e-9, 1e-9);
      for (Vec3& x : near.state.p) x += Vec3{d(random), d(random), d(random)};
      attachSprings(*near.model, near.stage, near.state, near.work);
      const double first = energyOf(*near.model, near.stage, near.state, near.work).total();
      double most = 1;
      State next;
      for (int k = 0; k < 300 && most < 1e6; ++k) {
        ASSERT_EQ(step(*near.model, near.stage, near.state, factor * dense, next, near.work).failure,
                  StepFailure::none);
        std::swap(near.state, next);
        most = std::max(most, energyOf(*near.model, near.stage, near.state, near.work).total() / first);
      }
      if (factor < 1) {
        EXPECT_LT(most, 1.1 / (1 - factor * factor));
      } else {
        EXPECT_GT(most, 1e3);
      }
    }
  }
}

TEST(DegeneratedMotion, SupportsHoldDirectorsInExplicitSteps) {
  // A strip clamped at one end and turned by an edge moment comes, damped, to the arc that statics say.
  const double L = 0.2, E = 4e6, t = 5e-3;
  const auto cloth = std::make_shared<DegeneratedShell>(flatSheet(6, 1, L, 0.02, isotropicSolid(E, 0, t, 500)));
  StructureOptions o;
  for (const auto& list :
       {cloth->mounting().holdEdge({0, Side::u0, false}, kAxes, {}), cloth->mounting().clampEdge({0, Side::u0, false}),
        cloth->mounting().mirrorEdge({0, Side::v0, false}, {0, 1, 0})})
    o.constraints.insert(o.constraints.end(), list.begin(), list.end());
  o.moments = {{{0, Side::u1, false}, -0.5 * E * t * t * t / 12 / L, 0}};  // half a radian along the strip
  o.programs = {{{0, 1}, {1, 1}}};
  o.rayleigh_mass_per_s = 20;
  const auto s = buildStructure(cloth, o);
  ExplicitSteps moving(*s);
  moving.run(1.6, 0);
  StructureOptions still = o;
  still.programs = {{{0, 1}, {0, 1}}};
  const auto held = buildStructure(cloth, still);
  std::vector<Vec3> q;
  std::vector<double> inner;
  StaticOptions options;
  options.steps = 4;
  const StaticReport report = solveStatic(*held, options, [&](const StaticPoint& p) {
    q = controlPoints(*held, p.y, p.factor);
    inner = innerValues(*held, p.y, p.factor);
    return true;
  });
  ASSERT_TRUE(report.reached) << report.why;
  // The director at the end has turned by half a radian.
  EXPECT_NEAR(std::atan2(inner[3 * 6], inner[3 * 6 + 2]), -0.5, 0.01);
  double off = 0;
  for (std::size_t i = 0; i < q.size(); ++i) off = std::max(off, norm(moving.state.p[i] - q[i]));
  for (std::size_t k = 0; k < inner.size(); ++k) off = std::max(off, L * std::abs(moving.state.inner[k] - inner[k]));
  EXPECT_LT(off, 1e-4 * L);
}

TEST(DegeneratedMotion, ModesOfAPlate) {
  // Simply supported square plate: omega = 2 pi² sqrt(D/(rho t))/a² (thin plate).
  const double a = 1, t = 0.01, E = 1e9, nu = 0.3, rho = 1000;
  const auto cloth = std::make_shared<DegeneratedShell>(flatSheet(16, 16, a, a, isotropicSolid(E, nu, t, rho)));
  StructureOptions o;
  for (const Side side : {Side::u0, Side::u1, Side::v0, Side::v1}) {
    const auto list = cloth->mounting().holdEdge({0, side, false}, kAxes, {});
    o.constraints.insert(o.constraints.end(), list.begin(), list.end());
  }
  const auto s = buildStructure(cloth, o);
  const std::vector<Mode> modes = naturalModes(*s, {}, 0, 2);
  const double D = E * t * t * t / (12 * (1 - nu * nu));
  EXPECT_NEAR(modes[0].omega_rad_per_s, 2 * kPi * kPi * std::sqrt(D / (rho * t)) / (a * a),
              0.01 * modes[0].omega_rad_per_s);
  EXPECT_NEAR(modes[1].omega_rad_per_s, 5 * kPi * kPi * std::sqrt(D / (rho * t)) / (a * a),
              0.02 * modes[1].omega_rad_per_s);
}

TEST(DegeneratedMotion, ImplicitStepsTurnAPlate) {
  const Moved m(flatSheet(2, 2, 0.1, 0.1, cotton(1e-3)));
  State state = structureState(*m.structure, 0, {}, {}, {});
  const std::vector<double> rest = state.inner;
  spinUp(m, {0, 2 * kPi, 0}, state);
  ImplicitOptions options;
  options.step_s = 1.0 / 200;
  options.lumped_mass = true;
  const double start = energyOf(*m.structure, state, true).total();
  ImplicitSteps(*m.structure, options)
      .advance(1, state, [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {});
  // What the scheme takes, at a spectral radius of 0.8, and where a turn ends.
  EXPECT_NEAR(energyOf(*m.structure, state, true).total() / start, 1, 5e-3);
  for (std::size_t d = 0; d < rest.size() / 3; ++d) {
    EXPECT_LT(norm(at(state.inner, d) - at(rest, d)), 0.05);
    EXPECT_LT(std::abs(dot(at(state.inner, d), at(state.inner_rate, d))), 1e-12);
  }
}

TEST(DegeneratedMotion, StiffnessDampingAloneTakesNothingOfTenTurns) {
  // A plate that tumbles about an axis askew to it, by Newmark's method, which for gamma = 1/2 takes nothing itself.
  StructureOptions o;
  o.rayleigh_stiffness_s = 1e-3;
  const Moved m(flatSheet(2, 2, 0.1, 0.1, cotton(1e-3)), {}, o);
  State state = structureState(*m.structure, 0, {}, {}, {});
  const Vec3 w{1, 6, 2};
  spinUp(m, w, state);
  ImplicitOptions options;
  options.scheme = ImplicitScheme::newmark;
  options.step_s = 2 * kPi / norm(w) / 200;
  options.lumped_mass = true;
  ImplicitSteps moving(*m.structure, options);
  const auto energyAfter = [&](double turns) {
    moving.advance(turns * 2 * kPi / norm(w), state,
                   [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {});
    return energyOf(*m.structure, state, true).total();
  };
  // It starts without the stretch that it turns with: half the square of a step's turn goes into that, once.
  const double start = energyOf(*m.structure, state, true).total(), first = energyAfter(1), end = energyAfter(10);
  printf(
      "[ measured ] b alone takes %.2e of the energy in ten turns, %.2e of it after the first; %.2f iterations a "
      "step\n",
      1 - end / start, 1 - end / first,
      static_cast<double>(moving.report().iterations) / static_cast<double>(moving.report().steps));
  EXPECT_LT(std::abs(1 - end / start), 1e-3);
  EXPECT_LT(std::abs(1 - end / first), 1e-4);
  EXPECT_LT(moving.report().iterations, 5 * moving.report().steps);
}

TEST(DegeneratedMotion, DampingByTheMaterialLetsAPlateTurn) {
  // b K_M (Man 2006, eq. 2.85) takes nothing of a turn of the whole, strained as it may be; stretching it costs.
  StructureOptions o;
  o.rayleigh_stiffness_s = 1;
  const Moved m(flatSheet(2, 2, 0.1, 0.1, cotton(1e-3)), {}, o);
  StructureSystem system(*m.structure, ProgramEnds::constant);
  const std::size_t points = m.cloth->rest().size(), n = static_cast<std::size_t>(system.size());
  std::vector<double> stretch(n, 0.0), y = system.start();
  for (std::size_t p = 0; p < points; ++p) stretch[3 * p] = 0.1 * m.cloth->rest()[p].x;
  system.retract(y, stretch, 1, 0, y);
  SymmetricMatrix D = system.sparsity();
  system.damping(y, 0, true, true, D);
  const Vec3 w{3, -2, 5};
  std::vector<double> turn(n, 0.0), force(n);
  for (std::size_t p = 0; p < points; ++p) {
    const Vec3 v = cross(w, m.cloth->rest()[p] + 0.1 * Vec3{m.cloth->rest()[p].x, 0, 0});
    for (int k = 0; k < 3; ++k) {
      turn[3 * p + static_cast<std::size_t>(k)] = v[k];
      const auto spin = 3 * points + 3 * p + static_cast<std::size_t>(k);
      turn[spin] = m.structure->dofs.unknownOf(static_cast<int>(spin), w[k]);
    }
  }
  const auto power = [&](const std::vector<double>& v) {
    multiply(D, v, force);
    double sum = 0;
    for (std::size_t k = 0; k < n; ++k) sum += v[k] * force[k];
    return sum;
  };
  EXPECT_GT(power(stretch), 0);
  EXPECT_LT(std::abs(power(turn)), 1e-10 * power(stretch));
}

}  // namespace
}  // namespace gambeson
