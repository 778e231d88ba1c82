#pragma once
/// Velocity Verlet with the contact split, in steps of a length that is stable.

#include "core/motion/integrator.hpp"

namespace gambeson {

struct StepControl {
  double safety = 0.9;  ///< of the stable step 2 / omega
  double max_step_s = 1e-3;
  int estimate_every = 50;  ///< steps between estimates of the largest frequency
  int max_halvings = 8;     ///< of a step that fails
  double fixed_s = 0;       ///< where positive: this step, stable or not
};

/// Equal steps between estimates of the largest frequency. A step that fails is tried again at half its length, one in
/// which strain limits and contacts do not agree down to an eighth; one that the stiffness has outgrown is taken back.
/// Model, stage, frequency (the last estimate) and work outlive it.
class VelocityVerlet : public Integrator {
 public:
  VelocityVerlet(const Model& model, const Stage& stage, const StepControl& control, Frequency& frequency,
                 StepWork& work);
  void advance(double until_s, State& state, const StepObserver& observe) override;

 private:
  double frequencyAtRest();
  /// Throws RunError where the cloth has become so stiff that something has crushed or torn it.
  void refuseCrushed(const State& state);
  /// The longest step that is stable, or fixed.
  double longestStep(State& state);
  /// The largest frequency at the end of a step of dt_s whose motion shows more than a stable step allows (loads that
  /// change show it too), where the step was longer than that allows; else 0.
  double unstableAt(const State& end, double dt_s);

  const Model& model_;
  const Stage& stage_;
  StepControl control_;
  Frequency& frequency_;
  StepWork& work_;
  double at_rest_rad_per_s_ = -1;  ///< the largest frequency of the cloth at rest; negative: not asked yet
};

}  // namespace gambeson
