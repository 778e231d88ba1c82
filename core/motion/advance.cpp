#include "core/motion/advance.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/motion/resonance.hpp"

namespace gambeson {
namespace {
constexpr int kColdIterations = 40, kWarmIterations = 8;
constexpr double kPinched = 64;  ///< part of a step below which samples count as pinched
constexpr int kMostCuts = 200;
constexpr double kLimitPieces = 8;  ///< a step in which strain limits and contacts do not agree is cut down to its 8th
/// Each estimate is of the stiffness at one moment. Steps that follow it up and down gain energy (a crumpled sheet
/// without drag 25 times its own in 0.4 s), so what is used stays near the largest of late.
constexpr double kFall = 0.995;
/// Steps until the next estimate, times the swing: cloth that swings far changes its stiffness as far. From a swing of
/// kCrumpling on cells collapse, and one mode may take over from another between two estimates.
constexpr double kStepsAtSwing = 6, kCrumpling = 0.5;
constexpr int kSoonest = 10;  ///< steps between estimates because of the shown frequency

/// The squared frequency that the last step's motion itself shows, |M^-1/2 df| / |M^1/2 dx|: where it nears the
/// estimate, the estimate is out of date.
double shownFrequency2(const Model& m, const State& before, const State& after) {
  double force2 = 0, way2 = 0;
  for (int i = 0; i < m.freeCount(); ++i) {
    force2 += m.mass_kg[i] * norm2(after.a[i] - before.a[i]);
    way2 += m.mass_kg[i] * norm2(after.p[i] - before.p[i]);
  }
  return way2 > 0 ? std::sqrt(force2 / way2) : 0;
}
}  // namespace

void advance(const Model& model, const Stage& stage, const StepControl& control, double until, State& state,
             Frequency& frequency, StepWork& work, const StepObserver& observe) {
  State next;
  while (state.time_s < until) {
    if (state.steps_to_estimate <= 0) {
      const bool cold = state.frequency_rad_per_s == 0 || state.steps_to_estimate < 0;
      frequency = largestFrequency(model, stage, state, cold ? kColdIterations : kWarmIterations, work);
      // A warm estimate may also have followed one mode while another rose.
      state.frequency_rad_per_s = std::max(frequency.largest_rad_per_s, kFall * state.frequency_rad_per_s);
      state.steps_to_estimate = control.estimate_every;
    }
    const double omega = std::max(state.frequency_rad_per_s, 1e-300);
    const double share = std::min(control.safety, state.share > 0 ? state.share : kFirstShare);
    // Threads that do not yield take what tension a step needs of them, more the shorter it is: these say nothing.
    const double across =
        std::isfinite(model.strain_limit.stiffness_N_per_m) ? tensionFrequency(model.strain_rows, state.limit_J) : 0;
    const double longest = std::min(control.max_step_s, share * 2 / std::hypot(omega, across));
    const double left = until - state.time_s;
    const double pieces = std::ceil(left / longest * (1 - 1e-12));
    double dt = pieces <= 1 ? left : left / pieces;
    StepReport report;
    const double whole = dt, shortest = dt / (1 << control.max_halvings);
    for (int cuts = 0;; ++cuts) {
      report = step(model, stage, state, dt, next, work);
      report.cuts = cuts;
      if (report.failure == StepFailure::none) {
        if (report.limit.solved || 0.5 * dt < whole / kLimitPieces) break;
        dt *= 0.5;
        continue;
      }
      const bool impact = report.failure == StepFailure::impact && report.earliest_impact < 1;
      if (impact && dt <= whole / kPinched && state.pinched != work.stuck) {
        state.pinched = work.stuck;  // no step is short enough: let them pass, and free them afterwards
        dt = whole;
        continue;
      }
      if (dt <= shortest || cuts == kMostCuts)
        throw RunError("no step at time " + std::to_string(state.time_s) + " s, down to " + std::to_string(dt * 1e6) +
                       " us: " + report.why);
      dt *= impact ? std::clamp(0.9 * report.earliest_impact, 0.1, 0.9) : 0.5;
    }
    if (pieces <= 1 && dt == left) next.time_s = until;
    --next.steps_to_estimate;
    next.swing = std::max(swing(model, state, next, dt, omega, work), kSwingHeld * state.swing);
    next.share = shareAtSwing(next.swing, state.share);
    const int since = control.estimate_every - next.steps_to_estimate;
    if (since >= kStepsAtSwing / next.swing) next.steps_to_estimate = next.swing > kCrumpling ? -1 : 0;
    if (since >= kSoonest && shownFrequency2(model, state, next) > 0.8 * omega * omega) next.steps_to_estimate = -1;
    observe(state, next, report, work, frequency);
    std::swap(state, next);
  }
}

}  // namespace gambeson
