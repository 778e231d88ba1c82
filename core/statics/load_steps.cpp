/// Load steps: an Euler predictor along the path, Newton, halving and growing back.

#include <fmt/format.h>

#include <cmath>

#include "core/statics/path.hpp"

namespace gambeson {
namespace {

/// What stopped Newton, as far as the tangents tell.
std::string likeliestCause(const System& system, const PathState& state, const NewtonReport& newton, double softening) {
  if (const std::string why = newton.finite ? "" : system.whyNotFinite(); !why.empty()) return why;
  if (newton.singular) return "the tangent is singular";
  if (state.solver.negativePivots() > 0 || newton.negative_pivots > 0 || softening < 0.1)
    return "a limit point or a bifurcation (the tangent loses its definiteness): follow the path by arc length";
  if (newton.stalled)
    return "the corrections are rounding, below 1e-14 of the structure's size, and the forces do not balance: the "
           "loads are too small beside the stiffness";
  if (!newton.finite) return "forces that are not finite: the step is too large, or a cell collapses";
  return "too large a step: take more steps";
}

/// Halvings of a step, failing where the tangent is not positive definite, after which a descent is tried: what lies
/// ahead is a limit point, and each halving costs two solutions that fail.
constexpr int kHalvingsBeforeDescent = 3;

}  // namespace

void followLoadSteps(System& system, const StaticOptions& options, const StaticObserver& observe, PathState& state,
                     StaticReport& report) {
  const long units = 1L << options.halvings, total = options.steps * units;
  const auto factorAt = [&](long position) { return static_cast<double>(position) / static_cast<double>(total); };
  std::vector<double> dg(static_cast<std::size_t>(system.size())), dy(dg.size()), trial;
  double first_stiffness = 0, softening = 1;  // work of the load on the tangent's motion, now against at first
  long position = 0, step = units;
  int unstable_failures = 0;  ///< of this whole step: Newton failed where the tangent has negative pivots
  bool descended = false;     ///< in vain, in this whole step
  /// `trial` is the next point; `dy` was the tangent's way there, with the other sign.
  const auto accept = [&](double factor, const NewtonReport& newton) {
    const double before = state.factor;
    state.y.swap(trial);
    state.factor = factor;
    StaticPoint point = acceptPoint(system, state, newton, report);
    for (double& v : dy) v = -v;
    point.jumped = hasJumped(system, options, trial, before, dy, state, report);
    commitPoint(system, state, point);
    return observe(point);
  };
  while (position < total) {
    const double next = factorAt(position + step);
    system.change(state.y, state.factor, next, dg);
    if (state.solver.solvable()) {
      state.solver.solve(dg, dy);
      const double rate = next - state.factor, work = dot(dg, dy) / (rate * rate);
      if (first_stiffness == 0) first_stiffness = work;
      softening = work != 0 ? first_stiffness / work : 1;
    } else {
      dy.assign(dy.size(), 0.0);
    }
    NewtonReport newton;
    bool singular = false;
    for (const bool line_search : {false, true}) {
      trial = state.y;
      system.retract(trial, dy, -1, next, trial);
      EquilibriumAt equilibrium(system, next);
      NewtonOptions n = newtonOptions(system, options, state);
      n.line_search = line_search;
      newton = solveNewton(equilibrium, n, trial, state.K, state.solver);
      report.factorisations += newton.factorisations;
      singular = singular || newton.singular;
      if (newton.converged) break;
    }
    if (newton.converged) {
      position += step;
      if (!accept(next, newton)) return;
      if (position % units == 0) unstable_failures = 0, descended = false;
      while (step < units && position % (2 * step) == 0 && newton.iterations <= options.iterations / 3) step *= 2;
      continue;
    }
    // The tangent of the last converged point again: predictor and diagnosis start there.
    restoreTangent(system, state, report);
    if (newton.negative_pivots > 0) ++unstable_failures;
    const bool early = unstable_failures > kHalvingsBeforeDescent && !descended;
    if (step > 1 && !early) {
      step /= 2;
      continue;
    }
    // The end of the path, as far as load steps can follow it: down to a stable state at the end of the whole step.
    const long target = (position / units + 1) * units;
    trial = state.y;
    for (double& v : dy) v *= static_cast<double>(target - position) / static_cast<double>(step);
    EquilibriumAt beyond(system, factorAt(target));
    NewtonOptions descent = newtonOptions(system, options, state);
    descent.descend = true;
    descent.iterations = 10 * options.iterations;
    const NewtonReport landing = solveNewton(beyond, descent, trial, state.K, state.solver);
    report.factorisations += landing.factorisations;
    if (landing.converged) {
      position = target;
      step = units;
      unstable_failures = 0, descended = false;
      if (!accept(factorAt(target), landing)) return;
      continue;
    }
    restoreTangent(system, state, report);
    if (step > 1) {  // smaller steps may still go on
      descended = true;
      step /= 2;
      continue;
    }
    newton.singular = singular;
    report.why = fmt::format(
        "load step {} of {}, from factor {:.6g} to {:.6g}: Newton's residual is {:.2e} of the forces after {} "
        "iterations, "
        "with steps halved {} times, and no stable state was found beyond; likeliest cause: {}. The last converged "
        "state is at factor {:.6g}",
        position / units + 1, options.steps, state.factor, next, newton.residual, newton.iterations, options.halvings,
        likeliestCause(system, state, newton, softening), state.factor);
    return;
  }
  report.reached = true;
}

}  // namespace gambeson
