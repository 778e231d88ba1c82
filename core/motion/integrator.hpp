#pragma once
/// What moves cloth from one time to another.

#include <functional>

#include "core/motion/step.hpp"

namespace gambeson {

/// Called after each accepted step; with what the step did.
using StepObserver = std::function<void(const State& before, const State& after, const StepReport&, const StepResult&,
                                        const Frequency&)>;

/// A scheme in time, with its control of the step. Each is a class of its own; structures name it by `solver.scheme`.
class Integrator {
 public:
  virtual ~Integrator() = default;
  /// Advances `state` to `until_s` exactly. Throws RunError saying why where no step gets on; `state` is the last
  /// accepted one then.
  virtual void advance(double until_s, State& state, const StepObserver& observe) = 0;
};

}  // namespace gambeson
