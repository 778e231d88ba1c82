#pragma once
/// A structure in motion, by explicit or implicit steps, for the tests.

#include "core/motion/implicit.hpp"
#include "core/motion/structure_motion.hpp"
#include "core/motion/velocity_verlet.hpp"
#include "unit/core/motion/empty_stage.hpp"

namespace gambeson::shapes {

using Watch = std::function<void(const State& before, const State& after, const StepReport&)>;

inline StepObserver observerOf(const Watch& watch) {
  return [&watch](const State& before, const State& after, const StepReport& r, const StepResult&, const Frequency&) {
    if (watch) watch(before, after, r);
  };
}

/// Explicit steps of a structure that touches nothing, from displacements y (empty: at rest).
struct ExplicitSteps {
  std::unique_ptr<Model> model;
  EmptyStage stage;
  StepWork work;
  Frequency frequency;
  State state;

  explicit ExplicitSteps(const Structure& s, const StrainLimit& limit = {}, std::span<const double> y = {})
      : model(untouchedModel(s, limit)) {
    state = initialState(*model, stage, 0, work);
    if (y.empty()) return;
    state.p = structureState(s, 0, y, {}, {}).p;
    attachSprings(*model, stage, state, work);
  }

  /// `dt_s` = 0: `safety` of the stable step.
  void run(double end_s, double dt_s, const Watch& watch = {}, double safety = 0.9) {
    StepControl control;
    control.fixed_s = dt_s;
    control.safety = safety;
    control.max_step_s = end_s;
    VelocityVerlet(*model, stage, control, frequency, work).advance(end_s, state, observerOf(watch));
  }
};

}  // namespace gambeson::shapes
