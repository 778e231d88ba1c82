#include "core/statics/path.hpp"

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

PathState::PathState(System& system) : y(system.start()), K(system.sparsity()), solver(system.sparsity()) {
  K.values.assign(K.rows.size(), 0.0);
}

NewtonOptions newtonOptions(const System& system, const StaticOptions& options, const PathState& state) {
  NewtonOptions n;
  n.iterations = options.iterations;
  n.tolerance = options.tolerance;
  n.least_force = 1e-3 * state.largest_force;
  n.length_m = system.reach();
  return n;
}

namespace {

double largestDiagonal(const SymmetricMatrix& K) {
  double largest = 0;
  for (int c = 0; c < K.size; ++c) largest = std::max(largest, K.values[K.offsets[c]]);
  return largest;
}

/// Where a first try strains the sheet by 1e-8 or so, what holds is of the order 1e-8 of the membrane's stiffness over
/// the square of the cells along it, and what does not is of the order of that strain's square, or of the rounding.
constexpr double kTryStrain = 1e-8, kTryRounding = 1e-13;

/// Factorises K: is there a motion without stiffness?
bool isLoose(PathState& state, double rounding) {
  state.definite = state.solver.factorise(state.K);
  return state.definite == Definiteness::singular || state.solver.smallestPivot() < rounding * largestDiagonal(state.K);
}

/// The factor of K + 1e-12 max K_ii: nothing is loose, and what has stiffness keeps it.
void factoriseRaised(PathState& state) {
  SymmetricMatrix K = state.K;
  const double raise = 1e-12 * largestDiagonal(K);
  for (int c = 0; c < K.size; ++c) K.values[K.offsets[c]] += raise;
  state.definite = state.solver.factorise(K);
}

/// K of the state, factorised; where it is singular and the loads p (of factor `next`) do not hold it: RunError.
void requireHeld(System& system, PathState& state, std::span<const double> p, double next, StaticReport& report) {
  const auto n = static_cast<std::size_t>(system.size());
  const auto mechanism = [&](const char* more) {
    return RunError("the structure is a mechanism: " + system.describe(weakestMotion(state.K)) + more);
  };
  state.raised = false;
  system.stiffness(state.y, state.factor, state.K);
  ++report.factorisations;
  if (!isLoose(state, system.looseness())) return;
  const double size = norm(p);
  if (!(size > 0)) throw mechanism("");
  factoriseRaised(state);
  ++report.factorisations;
  // K x = p: refinement takes the part of p that K can carry; what stays works on motions that K does not resist.
  std::vector<double> x(n, 0.0), left(p.begin(), p.end()), dx(n);
  for (int k = 0; k < 4 && state.solver.solvable(); ++k) {
    state.solver.solve(left, dx);
    for (std::size_t i = 0; i < n; ++i) x[i] += dx[i];
    multiply(state.K, x, left);
    for (std::size_t i = 0; i < n; ++i) left[i] = p[i] - left[i];
  }
  if (!(norm(left) <= 1e-6 * size)) throw mechanism("; the loads push along it");
  // So far along x that its stress is above rounding, and so little that second-order terms are below.
  double largest = 0;
  for (double v : x) largest = std::max(largest, std::abs(v));
  std::vector<double> y = state.y;
  system.retract(y, x, -(kTryStrain * system.length() / largest), next, y);
  const SymmetricMatrix at_start = state.K;
  system.stiffness(y, next, state.K);
  ++report.factorisations;
  if (!isFinite(state.K)) {
    system.residual(y, next, dx);
    throw RunError("at rest nothing but the loads holds the structure, and a little way along them " +
                   system.whyNotFinite());
  }
  if (isLoose(state, kTryRounding)) throw mechanism("; nor do the loads");
  state.K = at_start;
  state.raised = true;
  restoreTangent(system, state, report);
}

}  // namespace

void restoreTangent(System& system, PathState& state, StaticReport& report) {
  system.stiffness(state.y, state.factor, state.K);
  if (state.raised)
    factoriseRaised(state);
  else
    state.definite = state.solver.factorise(state.K);
  ++report.factorisations;
}

bool startPath(System& system, const StaticOptions& options, PathState& state, StaticReport& report) {
  const auto n = static_cast<std::size_t>(system.size());
  const double first = options.linear ? 1 : 1.0 / options.steps;
  std::vector<double> g(n), dy(n);
  const double force = system.residual(state.y, 0, g);
  system.stiffness(state.y, 0, state.K);
  if (norm(g) > std::max(options.tolerance * force, roundingForce(state.K, system.reach()))) {
    requireHeld(system, state, g, 0, report);
    if (state.raised) {
      state.solver.solve(g, dy);
      system.retract(state.y, dy, -1, 0, state.y);
    }
    EquilibriumAt at_zero(system, 0);
    NewtonOptions newton = newtonOptions(system, options, state);
    newton.line_search = true;
    const NewtonReport r = solveNewton(at_zero, newton, state.y, state.K, state.solver);
    report.factorisations += r.factorisations;
    if (!r.converged) {
      report.no_start = true;
      report.why = fmt::format(
          "the start is not in equilibrium at factor 0, and Newton finds none from it (residual {:.2e} of the forces "
          "after {} iterations)",
          r.residual, r.iterations);
      if (const std::string why = r.finite ? std::string() : system.whyNotFinite(); !why.empty())
        report.why += "; likeliest cause: " + why;
      return false;
    }
    state.largest_force = r.force;
    state.lost_J += system.commit(state.y, 0);
  }
  system.change(state.y, 0, first, g);
  requireHeld(system, state, g, first, report);
  if (state.raised && options.linear)
    throw RunError("the structure is a mechanism: " + system.describe(weakestMotion(state.K)) +
                   "; only the stress of its loads would, and a linear solution has none");
  return true;
}

StaticPoint acceptPoint(System& system, PathState& state, const NewtonReport& newton, StaticReport& report) {
  state.largest_force = std::max(state.largest_force, newton.force);
  state.raised = false;
  restoreTangent(system, state, report);
  ++report.points;
  return {state.factor, state.y, newton.iterations, newton.residual, newton.rounded, state.solver.negativePivots()};
}

void commitPoint(System& system, PathState& state, StaticPoint& point) {
  state.lost_J += system.commit(state.y, state.factor);
  point.history.assign(system.history().begin(), system.history().end());
  point.lost_J = state.lost_J;
}

namespace {

void solveLinear(System& system, const StaticOptions&, const StaticObserver& observe, PathState& state,
                 StaticReport& report) {
  std::vector<double> dg(static_cast<std::size_t>(system.size())), dy(dg.size()), g(dg.size());
  system.change(state.y, 0, 1, dg);
  state.solver.solve(dg, dy);
  for (double& v : dy) v = -v;
  multiply(state.K, dy, g);
  system.retract(system.start(), dy, 1, 1, state.y);
  for (std::size_t i = 0; i < g.size(); ++i) g[i] += dg[i];
  const double size = norm(dg);
  report.points = 1;
  report.reached = true;
  observe({1, state.y, 1, size > 0 ? norm(g) / size : 0, false, state.solver.negativePivots()});
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
  if (system.size() == 0) throw InputError({"", 0, "supports"}, "hold every control point; nothing is left to move");
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
