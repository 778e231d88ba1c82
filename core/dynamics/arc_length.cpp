/// Cylindrical arc length (Crisfield 1981): |dy| = l along the step, through limit points and snap-backs.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/dynamics/path.hpp"

namespace gambeson {
namespace {

constexpr int kIterationsWanted = 5;
constexpr double kLongest = 4;       ///< arc, against the first
constexpr int kMostIterations = 15;  ///< a corrector that needs more has an arc that is too long
constexpr int kDoubtHalvings = 6;    ///< a doubtful step is taken all the same after so many: a bifurcation

/// -dg/dfactor: what the load adds per factor.
void loadRate(System& system, std::span<const double> y, double factor, std::span<double> p) {
  constexpr double h = 1e-3;
  system.change(y, factor, factor + h, p);
  for (double& v : p) v /= -h;
}

struct Increment {
  std::vector<double> dy;
  double dfactor = 0;
};

/// The change x of the factor with |a + x b| = length; of the two roots the one whose increment turns least from `dy`.
std::optional<double> onCylinder(std::span<const double> dy, std::span<const double> a, std::span<const double> b,
                                 double length) {
  const double bb = dot(b, b), ab = dot(a, b), c = dot(a, a) - length * length;
  const double discriminant = ab * ab - bb * c;
  if (!(discriminant >= 0) || !(bb > 0)) return std::nullopt;
  const double root = std::sqrt(discriminant);
  const double x1 = (-ab + root) / bb, x2 = (-ab - root) / bb;
  const double along = dot(dy, b);  // dy . (a + x b) grows with x where this is positive
  return along >= 0 ? x1 : x2;
}

/// Corrects from the predictor `inc` at constant arc. K and solver of the state are scratch. `by_load` becomes the
/// motion per factor at the last iterate but one.
NewtonReport correct(System& system, const NewtonOptions& options, double length, PathState& state, Increment& inc,
                     std::vector<double>& by_load) {
  const std::size_t n = state.y.size();
  NewtonReport report;
  std::vector<double> y(n), r(n), p(n), by_residual(n), a(n);
  for (;; ++report.iterations) {
    for (std::size_t i = 0; i < n; ++i) y[i] = state.y[i] + inc.dy[i];
    const double factor = state.factor + inc.dfactor;
    report.force = std::max(system.residual(y, factor, r), options.least_force);
    const double size = norm(r);
    report.residual = size == 0 ? 0 : size / report.force;
    report.residuals.push_back(report.residual);
    report.finite = std::isfinite(size);
    if (!report.finite) return report;
    const bool balanced = size <= options.tolerance * report.force;
    if (balanced || endsByRounding(size, report.force, roundingForce(state.K, options.length_m), false)) {
      report.converged = true;
      report.rounded = !balanced;
      return report;
    }
    if (report.iterations == options.iterations) return report;
    system.stiffness(y, factor, state.K);
    report.finite = isFinite(state.K);
    if (!report.finite) return report;
    report.singular = state.solver.factorise(state.K) == Definiteness::singular;
    report.negative_pivots = state.solver.negativePivots();
    ++report.factorisations;
    if (!state.solver.solvable()) return report;
    loadRate(system, y, factor, p);
    state.solver.solve(r, by_residual);
    state.solver.solve(p, by_load);
    for (std::size_t i = 0; i < n; ++i) a[i] = inc.dy[i] - by_residual[i];
    const std::optional<double> x = onCylinder(inc.dy, a, by_load, length);
    if (!x || !std::isfinite(*x)) {
      report.finite = false;
      return report;
    }
    for (std::size_t i = 0; i < n; ++i) inc.dy[i] = a[i] + *x * by_load[i];
    inc.dfactor += *x;
  }
}

/// Whether a step may have left the path between its ends. The cylinder about the start cuts a path that bends back on
/// itself (a snap-back) more than once, and the corrector may land where the path comes in again: there it leads
/// against the step, so that going on along the step would lead back to where it came from. `by_load` is the motion per
/// factor at the end, `forward` the sign of the factor's change at the start. Between simple limit points the factor
/// turns exactly where the determinant of K changes its sign: at the way in the two disagree. At a bifurcation they
/// disagree too, on any arc.
bool isDoubtful(const Increment& inc, std::span<const double> by_load, double forward, int more_negative_pivots) {
  const double along = dot(inc.dy, by_load);
  return (along * forward < 0) != (more_negative_pivots % 2 != 0);
}

/// Where the step passed the factor wanted: the equilibrium at that factor, from the chord.
bool landOn(System& system, const StaticOptions& options, double factor, PathState& state, const Increment& inc,
            NewtonReport& newton, StaticReport& report) {
  std::vector<double> y = state.y;
  const double part = (factor - state.factor) / inc.dfactor;
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += part * inc.dy[i];
  EquilibriumAt equilibrium(system, factor);
  newton = solveNewton(equilibrium, newtonOptions(system, options, state), y, state.K, state.solver);
  report.factorisations += newton.factorisations;
  double moved = 0;
  for (std::size_t i = 0; i < y.size(); ++i) moved += (y[i] - state.y[i]) * (y[i] - state.y[i]);
  if (!newton.converged || std::sqrt(moved) > 1.5 * norm(inc.dy)) return false;
  state.y = y;
  state.factor = factor;
  return true;
}

}  // namespace

void followArc(System& system, const StaticOptions& options, const StaticObserver& observe, PathState& state,
               StaticReport& report) {
  const std::size_t n = state.y.size();
  std::vector<double> p(n), tangent(n), last(n, 0.0), by_load(n);
  double length = 0, first_length = 0, forward = 1;
  const double way = options.stop_factor >= state.factor ? 1 : -1;
  int halvings = 0;
  while (report.points < options.max_points) {
    loadRate(system, state.y, state.factor, p);
    if (state.solver.solvable()) state.solver.solve(p, tangent);
    const double size = norm(tangent);
    if (!(size > 0) || !std::isfinite(size)) {
      report.why = fmt::format("arc length at factor {:.6g}: the load moves nothing", state.factor);
      return;
    }
    if (length == 0) length = first_length = size / options.steps;
    // Along the path as it came: through limit points and snap-backs alike (Feng et al. 1995).
    forward = report.points == 0 ? way : dot(last, tangent) >= 0 ? 1 : -1;
    Increment inc{tangent, forward * length / size};
    for (double& v : inc.dy) v *= inc.dfactor;
    NewtonOptions corrector = newtonOptions(system, options, state);
    corrector.iterations = std::min(corrector.iterations, kMostIterations);
    const int pivots = state.solver.negativePivots();
    NewtonReport newton = correct(system, corrector, length, state, inc, by_load);
    report.factorisations += newton.factorisations;
    // A step that turns back has lost the path.
    const double turn = report.points == 0 ? 1 : dot(inc.dy, last) / (norm(inc.dy) * norm(last));
    const bool doubtful = newton.iterations > 0 && halvings < kDoubtHalvings &&
                          isDoubtful(inc, by_load, forward, newton.negative_pivots - pivots);
    if (!newton.converged || turn < -0.2 || doubtful) {
      restoreTangent(system, state, report);
      if (++halvings > 2 * options.halvings) {
        report.why = fmt::format(
            "arc length, point {} at factor {:.6g}: the residual is {:.2e} of the forces after {} iterations, with the "
            "arc halved to {:.2e} of the first; likeliest cause: {}. The last converged state is at factor {:.6g}",
            report.points + 1, state.factor, newton.residual, newton.iterations, length / first_length,
            newton.singular ? "the tangent is singular" : "a bifurcation, or a kink of a law", state.factor);
        return;
      }
      length *= 0.5;
      continue;
    }
    halvings = 0;
    const bool passed = way * (state.factor + inc.dfactor - options.stop_factor) >= 0;
    if (passed) {
      NewtonReport landed;
      if (landOn(system, options, options.stop_factor, state, inc, landed, report)) {
        observe(acceptPoint(system, state, landed, report));
        report.reached = true;
        return;
      }
    }
    for (std::size_t i = 0; i < n; ++i) state.y[i] += inc.dy[i];
    state.factor += inc.dfactor;
    last = inc.dy;
    const bool more = observe(acceptPoint(system, state, newton, report));
    report.reached = passed;
    if (passed || !more) return;
    const double ratio = std::sqrt(static_cast<double>(kIterationsWanted) / std::max(newton.iterations, 1));
    length = std::min(length * std::clamp(ratio, 0.5, 2.0), kLongest * first_length);
  }
  report.why = fmt::format("arc length: {} points, and the factor is {:.6g}", report.points, state.factor);
}

}  // namespace gambeson
