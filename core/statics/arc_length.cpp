/// Cylindrical arc length (Crisfield 1981): |dy| = l along the step, through limit points and snap-backs.
///
/// The arc follows the curvature of the path: a step whose ends do not agree on a nearly straight way between them (see
/// `bend`) is taken again with a shorter arc. How soft the structure is at the start says nothing of its snaps.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/statics/path.hpp"

namespace gambeson {
namespace {

constexpr int kIterationsWanted = 5;
constexpr double kLongest = 4;       ///< arc, against the first
constexpr int kMostIterations = 15;  ///< a corrector that needs more has an arc that is too long
constexpr int kDoubtHalvings = 6;    ///< a doubtful step is taken all the same after so many: a bifurcation
constexpr int kCurveCuts = 12;       ///< and one that bends too much after so many: a kink
/// What a straight line between two points may miss of the path: of the largest displacement and of the largest factor
/// so far. These count as at least so much of the structure's length and of the factor where the path is to stop.
constexpr double kSag = 0.01, kLeastPart = 0.02;
constexpr double kTurn = 0.7;         ///< cosine between the directions at both ends of a step, at least
constexpr double kMostCut = 1. / 64;  ///< of an arc at a time

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
  const auto n = static_cast<std::size_t>(system.size());
  NewtonReport report;
  std::vector<double> y(state.y.size()), r(n), p(n), by_residual(n), a(n);
  for (;; ++report.iterations) {
    const double factor = state.factor + inc.dfactor;
    system.retract(state.y, inc.dy, 1, factor, y);
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

/// Heading of the path at a point, by arc: displacements and factor.
struct Heading {
  std::vector<double> dy;
  double dfactor = 0;

  /// `by_load` is the motion per factor there, and the path goes on along `along`.
  Heading(std::span<const double> by_load, std::span<const double> along) : dy(by_load.begin(), by_load.end()) {
    const double size = norm(by_load) * (dot(by_load, along) >= 0 ? 1 : -1);
    for (double& v : dy) v /= size;
    dfactor = 1 / size;
  }
};

double largestOf(std::span<const double> v) {
  double most = 0;
  for (double x : v) most = std::max(most, std::abs(x));
  return most;
}

/// How much a step bends, against what is allowed (1): the sag of the path over its chord, (arc/8) |change of
/// direction|, in displacements and in the factor; how far the factor at its end is from the mean of the rates at both
/// ends, which is small unless the path rose or fell in between; and the turn of the displacements.
/// `size_m` and `size`: the largest displacement and factor that count.
double bend(const Increment& inc, double arc, const Heading& start, const Heading& end, double size_m, double size) {
  double change = 0;
  for (std::size_t i = 0; i < start.dy.size(); ++i) change = std::max(change, std::abs(end.dy[i] - start.dy[i]));
  const double sag_m = arc / 8 * change, sag = arc / 8 * std::abs(end.dfactor - start.dfactor),
               missed = std::abs(inc.dfactor - 0.5 * arc * (start.dfactor + end.dfactor));
  double much = std::max({sag_m / (kSag * size_m), sag / (kSag * size), 0.5 * missed / (kSag * size)});
  if (dot(start.dy, end.dy) < kTurn) much = std::max(much, 4.);
  return std::isfinite(much) ? much : std::numeric_limits<double>::max();
}

/// Where the step passed the factor wanted: the equilibrium at that factor, from the chord.
bool landOn(System& system, const StaticOptions& options, double factor, PathState& state, const Increment& inc,
            NewtonReport& newton, StaticReport& report) {
  std::vector<double> y = state.y;
  const double part = (factor - state.factor) / inc.dfactor;
  system.retract(y, inc.dy, part, factor, y);
  EquilibriumAt equilibrium(system, factor);
  newton = solveNewton(equilibrium, newtonOptions(system, options, state), y, state.K, state.solver);
  report.factorisations += newton.factorisations;
  double moved = 0;
  for (std::size_t i = 0; i < inc.dy.size(); ++i) moved += (y[i] - state.y[i]) * (y[i] - state.y[i]);
  if (!newton.converged || std::sqrt(moved) > 1.5 * norm(inc.dy)) return false;
  state.y = y;
  state.factor = factor;
  return true;
}

}  // namespace

void followArc(System& system, const StaticOptions& options, const StaticObserver& observe, PathState& state,
               StaticReport& report) {
  const auto n = static_cast<std::size_t>(system.size());
  std::vector<double> p(n), tangent(n), last(n, 0.0), by_load(n);
  double length = 0, first_length = 0, forward = 1;
  const double way = options.stop_factor >= state.factor ? 1 : -1;
  double size_m = kLeastPart * system.length(), size = kLeastPart * std::abs(options.stop_factor - state.factor);
  int halvings = 0, cuts = 0;
  while (report.points < options.max_points) {
    loadRate(system, state.y, state.factor, p);
    if (state.solver.solvable()) state.solver.solve(p, tangent);
    const double per_factor = norm(tangent);
    if (!(per_factor > 0) || !std::isfinite(per_factor)) {
      report.why = fmt::format("arc length at factor {:.6g}: the load moves nothing", state.factor);
      return;
    }
    if (length == 0) length = first_length = per_factor / options.steps;
    if (options.largest_arc_m > 0) length = std::min(length, options.largest_arc_m * per_factor / largestOf(tangent));
    // Along the path as it came: through limit points and snap-backs alike (Feng et al. 1995).
    forward = report.points == 0 ? way : dot(last, tangent) >= 0 ? 1 : -1;
    Increment inc{tangent, forward * length / per_factor};
    for (double& v : inc.dy) v *= inc.dfactor;
    const Heading start(tangent, inc.dy);
    NewtonOptions corrector = newtonOptions(system, options, state);
    corrector.iterations = std::min(corrector.iterations, kMostIterations);
    const int pivots = state.solver.negativePivots();
    by_load = tangent;
    NewtonReport newton = correct(system, corrector, length, state, inc, by_load);
    report.factorisations += newton.factorisations;
    // A step that turns back has lost the path.
    const double turn = report.points == 0 ? 1 : dot(inc.dy, last) / (norm(inc.dy) * norm(last));
    const bool looked = newton.iterations > 0;
    const bool doubtful = looked && isDoubtful(inc, by_load, forward, newton.negative_pivots - pivots);
    // The tangent of the last iterate but one is that of the end to the square root of the tolerance.
    const Heading end(by_load, inc.dy);
    double much = 0;
    if (newton.converged) {
      for (std::size_t i = 0; i < n; ++i) size_m = std::max(size_m, std::abs(state.y[i]));
      size = std::max({size, std::abs(state.factor),
                       std::min(std::abs(state.factor + inc.dfactor), std::abs(options.stop_factor))});
      much = bend(inc, length, start, end, size_m, size);
    }
    const bool bent = much > 1 && cuts < kCurveCuts;
    if (!newton.converged || turn < -0.2 || (doubtful && halvings < kDoubtHalvings) || bent) {
      restoreTangent(system, state, report);
      if (newton.converged && turn >= -0.2 && bent) {
        ++cuts;
        length *= std::clamp(0.9 / std::sqrt(much), kMostCut, 0.7);
        continue;
      }
      if (++halvings > 2 * options.halvings) {
        const std::string why = newton.finite ? std::string() : system.whyNotFinite();
        report.why = fmt::format(
            "arc length, point {} at factor {:.6g}: the residual is {:.2e} of the forces after {} iterations, with the "
            "arc halved to {:.2e} of the first; likeliest cause: {}. The last converged state is at factor {:.6g}",
            report.points + 1, state.factor, newton.residual, newton.iterations, length / first_length,
            !why.empty()      ? why
            : newton.singular ? "the tangent is singular"
                              : "a bifurcation, or a kink of a law",
            state.factor);
        return;
      }
      length *= 0.5;
      continue;
    }
    halvings = cuts = 0;
    const auto accept = [&](const NewtonReport& converged) {
      StaticPoint point = acceptPoint(system, state, converged, report);
      point.jumped = much > 1;
      point.limit_point = start.dfactor * end.dfactor < 0;
      point.bifurcation = ((point.negative_pivots - pivots) % 2 != 0) != point.limit_point;
      commitPoint(system, state, point);
      return observe(point);
    };
    const bool passed = way * (state.factor + inc.dfactor - options.stop_factor) >= 0;
    if (passed) {
      NewtonReport landed;
      if (landOn(system, options, options.stop_factor, state, inc, landed, report)) {
        accept(landed);
        report.reached = true;
        return;
      }
    }
    state.factor += inc.dfactor;
    system.retract(state.y, inc.dy, 1, state.factor, state.y);
    last = inc.dy;
    const bool more = accept(newton);
    report.reached = passed;
    if (passed || !more) return;
    const double by_iterations = std::sqrt(static_cast<double>(kIterationsWanted) / std::max(newton.iterations, 1)),
                 by_bend = much > 0 ? 0.9 / std::sqrt(much) : 2;
    length = std::min(length * std::clamp(std::min(by_iterations, by_bend), 0.5, 2.0), kLongest * first_length);
  }
  report.why = fmt::format("arc length: {} points, and the factor is {:.6g}", report.points, state.factor);
}

}  // namespace gambeson
