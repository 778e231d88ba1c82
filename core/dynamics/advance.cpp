#include "core/dynamics/advance.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {
namespace {
constexpr int kColdIterations = 40, kWarmIterations = 6;
}

void advance(const Model& model, const Stage& stage, const StepControl& control, double until, State& state, Frequency& frequency,
             StepWork& work, const StepObserver& observe) {
  State next;
  while (state.time_s < until) {
    if (state.steps_to_estimate <= 0) {
      frequency = largestFrequency(model, stage, state, state.frequency_rad_per_s > 0 ? kWarmIterations : kColdIterations, work);
      state.frequency_rad_per_s = frequency.largest_rad_per_s;
      state.steps_to_estimate = control.estimate_every;
    }
    const double longest = std::min(control.max_step_s, control.safety * 2 / std::max(state.frequency_rad_per_s, 1e-300));
    const double left = until - state.time_s;
    const double pieces = std::ceil(left / longest * (1 - 1e-12));
    double dt = pieces <= 1 ? left : left / pieces;
    StepReport report;
    for (int halvings = 0;; ++halvings) {
      report = step(model, stage, state, dt, next, work);
      if (report.failure == StepFailure::none) break;
      if (halvings == control.max_halvings)
        throw RunError("no step at time " + std::to_string(state.time_s) + " s, down to " + std::to_string(dt * 1e6) + " us: " + report.why);
      dt *= 0.5;
    }
    if (pieces <= 1 && dt == left) next.time_s = until;
    --next.steps_to_estimate;
    observe(state, next, report, work, frequency);
    std::swap(state, next);
  }
}

}  // namespace gambeson
