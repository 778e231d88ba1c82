#pragma once
/// The control of the step that all schemes share which step a Model: pieces, cuts, estimates of the frequency, steps
/// that are taken back.

#include "core/motion/integrator.hpp"

namespace gambeson {

struct StepControl {
  double safety = 0.9;  ///< of the stable step: 2 / omega, of velocity Verlet
  double max_step_s = 1e-3;
  int estimate_every = 50;  ///< steps between estimates of the largest frequency
  int max_halvings = 8;     ///< of a step that fails
  double fixed_s = 0;       ///< where positive: this step, stable or not
  /// Velocity Verlet keeps account of what it makes or takes of energy (WorkAudit::integrator): one more evaluation of
  /// the energy a step. The other schemes always do.
  bool audits_energy = false;
};

/// Equal steps between estimates of the largest frequency. A step that fails is tried again at half its length, one in
/// which strain limits and contacts do not agree down to an eighth; one that the stiffness has outgrown is taken back.
/// Model, stage, frequency (the last estimate) and work outlive it.
class ControlledSteps : public Integrator {
 public:
  void advance(double until_s, State& state, const StepObserver& observe) override;

 protected:
  ControlledSteps(const Model& model, const Stage& stage, const StepControl& control, Frequency& frequency,
                  StepWork& work, FrequencyOf of);

  virtual StepReport makeStep(const State& in, double dt_s, State& out) = 0;
  /// The step that is aimed at where none is fixed.
  virtual double longestStep(State& state) = 0;
  /// Whether a motion of this squared frequency outruns a step.
  virtual bool outruns(double omega2, double dt_s) const = 0;
  /// The longest step that is stable at a frequency, for messages.
  virtual double stableStep(double omega_rad_per_s) const = 0;
  /// After a step with a step control of its own: says when to look at the frequency again. `shown2`: the squared
  /// frequency that the step's motion has shown.
  virtual void settle(const State& before, State& after, double dt_s, double shown2) = 0;

  /// The squared frequency that the step's motion itself shows, |M^-1/2 df| / |M^1/2 dx|: where it nears the estimate,
  /// the estimate is out of date.
  virtual double shownFrequency2(const State& before, const State& after);
  /// The largest frequency at a state, where a step begins or ends, and its mode (largestFrequency).
  virtual Frequency lookAtFrequency(State& state, int iterations);
  /// Before the points of a state are read, or the scratch of steps is written to: gives it its points, where these
  /// stand elsewhere, and waits for whoever else has the scratch.
  virtual void bringBack(State&) {}

  /// Looks at the frequency where it is time, throws RunError where the cloth is crushed. Sets
  /// state.frequency_rad_per_s.
  void estimate(State& state);
  /// Steps until the next look are one fewer; a motion that nears the estimate asks for it at once.
  void countDown(State& after, double shown2) const;

  const Model& model_;
  const Stage& stage_;
  StepControl control_;
  Frequency& frequency_;
  StepWork& work_;

 private:
  double frequencyAtRest();
  void refuseCrushed(State& state);
  /// The strains of the points whose law is an energy at a point.
  std::optional<StrainBox> lawStrains(const State& state);
  /// Makes `next`, in cuts where it fails. Returns the length that worked.
  StepReport makeInCuts(State& state, double& dt_s, State& next);
  /// The largest frequency at the end of a step of dt_s whose motion shows more than a stable step allows (loads that
  /// change show it too), where the step was longer than that allows; else 0.
  double unstableAt(const State& end, double dt_s);
  bool accepts(State& state, State& next, double dt_s);

  FrequencyOf of_;
  double at_rest_rad_per_s_ = -1;  ///< the largest frequency of the cloth at rest; negative: not asked yet
  int rejections_ = 0;
  bool has_law_strains_ = false;  ///< whether laws of the cloth are an energy at a point
  std::vector<Vec3> q_;           ///< scratch of lawStrains
};

}  // namespace gambeson
