#pragma once
/// Steps of a length that is stable, up to a given time.

#include <functional>

#include "core/motion/step.hpp"

namespace gambeson {

struct StepControl {
  double safety = 0.9;  ///< of the stable step 2 / omega
  double max_step_s = 1e-3;
  int estimate_every = 50;  ///< steps between estimates of the largest frequency
  int max_halvings = 8;     ///< of a step that fails
};

/// Called after each accepted step; with what the step did.
using StepObserver = std::function<void(const State& before, const State& after, const StepReport&, const StepResult&,
                                        const Frequency&)>;

/// Advances `state` to `until_s` exactly, in equal steps between estimates. A step that fails is tried again at half
/// its length, one in which strain limits and contacts do not agree down to an eighth; throws RunError saying why where
/// that does not help. `frequency` carries the last estimate.
void advance(const Model& model, const Stage& stage, const StepControl& control, double until_s, State& state,
             Frequency& frequency, StepWork& work, const StepObserver& observe);

}  // namespace gambeson
