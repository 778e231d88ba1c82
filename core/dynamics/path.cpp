#include "core/dynamics/path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "core/error.hpp"

namespace gambeson {

std::vector<double> weakestMotion(const SymmetricMatrix& K) {
  SymmetricMatrix shifted = K;
  double largest = 0;
  for (int c = 0; c < K.size; ++c) largest = std::max(largest, std::abs(K.values[K.offsets[c]]));
  for (int c = 0; c < K.size; ++c) {
    double& d = shifted.values[K.offsets[c]];
    d += 1e-9 * (std::abs(d) + 1e-3 * largest);
  }
  SymmetricFactor factor(shifted);
  std::vector<double> x(K.size), y(K.size);
  std::uint64_t seed = 1;
  for (double& v : x) {  // any vector that is blind to nothing
    seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
    v = static_cast<double>(seed >> 33) / 4294967296.0 - 0.25;
  }
  factor.factorise(shifted);
  if (!factor.solvable()) return x;
  for (int k = 0; k < 4; ++k) {
    factor.solve(x, y);
    const double size = norm(y);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = y[i] / size;
  }
  return x;
}

PathState::PathState(System& system) : y(system.size(), 0.0), K(system.pattern()), solver(system.pattern()) {
  K.values.assign(K.rows.size(), 0.0);
}

NewtonOptions newtonOptions(const System& system, const StaticOptions& options, const PathState& state) {
  NewtonOptions n;
  n.iterations = options.iterations;
  n.tolerance = options.tolerance;
  n.least_force = 1e-3 * state.largest_force;
  n.length_m = system.length();
  return n;
}

bool startPath(System& system, const StaticOptions& options, PathState& state, StaticReport& report) {
  const auto tangent = [&] {
    system.stiffness(state.y, 0, state.K);
    state.definite = state.solver.factorise(state.K);
    ++report.factorisations;
    // Strains at rest are rounding, and their stress is a stiffness of eps of the membrane's in every direction: what
    // resists less than that is not held.
    double largest = 0;
    for (int c = 0; c < state.K.size; ++c) largest = std::max(largest, state.K.values[state.K.offsets[c]]);
    if (state.definite == Definiteness::singular || state.solver.smallestPivot() < 1e-15 * largest)
      throw RunError("the structure is a mechanism: " + system.describe(weakestMotion(state.K)));
  };
  tangent();
  std::vector<double> g(state.y.size());
  const double force = system.residual(state.y, 0, g);
  if (norm(g) > std::max(options.tolerance * force, roundingForce(state.K, system.length()))) {
    EquilibriumAt at_zero(system, 0);
    NewtonOptions newton = newtonOptions(system, options, state);
    newton.line_search = true;
    const NewtonReport n = solveNewton(at_zero, newton, state.y, state.K, state.solver);
    report.factorisations += n.factorisations;
    if (!n.converged) {
      report.why = fmt::format(
          "the start is not in equilibrium at factor 0, and Newton finds none from it (residual {:.2e} of the forces "
          "after {} iterations)",
          n.residual, n.iterations);
      return false;
    }
    state.largest_force = n.force;
    tangent();
  }
  return true;
}

StaticPoint acceptPoint(System& system, PathState& state, const NewtonReport& newton, StaticReport& report) {
  state.largest_force = std::max(state.largest_force, newton.force);
  system.stiffness(state.y, state.factor, state.K);
  state.definite = state.solver.factorise(state.K);
  ++report.factorisations;
  ++report.points;
  return {state.factor, state.y, newton.iterations, newton.residual, state.solver.negativePivots()};
}

namespace {

void solveLinear(System& system, const StaticOptions&, const StaticObserver& observe, PathState& state,
                 StaticReport& report) {
  std::vector<double> dg(state.y.size()), g(state.y.size());
  system.change(state.y, 0, 1, dg);
  state.solver.solve(dg, state.y);
  for (double& v : state.y) v = -v;
  multiply(state.K, state.y, g);
  for (std::size_t i = 0; i < g.size(); ++i) g[i] += dg[i];
  const double size = norm(dg);
  report.points = 1;
  report.reached = true;
  observe({1, state.y, 1, size > 0 ? norm(g) / size : 0, state.solver.negativePivots()});
}

}  // namespace

StaticReport followPath(System& system, const StaticOptions& options, const StaticObserver& observe,
                        std::vector<double> start) {
  if (options.steps < 1 || options.iterations < 1 || options.halvings < 0 || options.halvings > 30 ||
      !(options.tolerance > 0))
    throw InputError({"", 0, "static"}, "steps, iterations and tolerance must be > 0, halvings 0 to 30");
  PathState state(system);
  StaticReport report;
  if (!start.empty()) {
    if (start.size() != state.y.size())
      throw InputError({"", 0, "start"}, fmt::format("{} unknowns, expected {}", start.size(), state.y.size()));
    state.y = std::move(start);
  }
  if (state.y.empty()) throw InputError({"", 0, "supports"}, "hold every control point; nothing is left to move");
  if (!startPath(system, options, state, report)) return report;
  if (options.linear)
    solveLinear(system, options, observe, state, report);
  else if (options.arc_length)
    followArc(system, options, observe, state, report);
  else
    followLoadSteps(system, options, observe, state, report);
  return report;
}

}  // namespace gambeson
