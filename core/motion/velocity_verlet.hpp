#pragma once
/// Velocity Verlet with the contact split, in steps of a length that is stable.

#include "core/motion/step_control.hpp"

namespace gambeson {

/// ControlledSteps of `step`: stable up to 2/omega, less where the highest modes swing far (resonance.hpp), omega with
/// the frequency of penalties.
class VelocityVerlet : public ControlledSteps {
 public:
  VelocityVerlet(const Model& model, const Stage& stage, const StepControl& control, Frequency& frequency,
                 StepWork& work);

 private:
  StepReport makeStep(const State& in, double dt_s, State& out) override;
  double longestStep(State& state) override;
  bool outruns(double omega2, double dt_s) const override { return omega2 * dt_s * dt_s > 4; }
  double stableStep(double omega_rad_per_s) const override { return 2 / omega_rad_per_s; }
  void settle(const State& before, State& after, double dt_s, double shown2) override;
  /// How far the highest modes swing, of which the largest has the frequency omega (resonance.hpp).
  virtual double swingOf(const State& before, const State& after, double dt_s, double omega_rad_per_s);

  double pressing_rad_per_s_;  ///< of a penalty, which no estimate sees (penaltyFrequency)
};

}  // namespace gambeson
