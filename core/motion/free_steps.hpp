#pragma once
/// The schemes that step a Model beside velocity Verlet, and the choice among all of them.

#include "core/motion/implicit_velocities.hpp"
#include "core/motion/motion_options.hpp"
#include "core/motion/runge_kutta.hpp"
#include "core/motion/step_control.hpp"

namespace gambeson {

/// ControlledSteps of `freeStep`. Steps are `safety` times the longest in which the highest mode does not grow
/// (longestStableStep; drag of the points that it damps least), of the semi-implicit scheme the substeps that bending
/// alone allows, of implicit Euler max_step_s, or what inner unknowns without rows in the tangent allow. Throws
/// InputError (key "scheme") for Euler and midpoint without drag, which no step keeps from growing, unless the step is
/// fixed, and for limits of strain.
class FreeSteps : public ControlledSteps {
 public:
  FreeSteps(const Model& model, const Stage& stage, const MotionOptions& options, const StepControl& control,
            Frequency& frequency, StepWork& work);

 private:
  StepReport makeStep(const State& in, double dt_s, State& out) override;
  double longestStep(State& state) override;
  bool outruns(double omega2, double dt_s) const override;
  double stableStep(double omega_rad_per_s) const override;
  void settle(const State& before, State& after, double dt_s, double shown2) override;

  MotionOptions options_;
  double damping_per_s_ = 0;
  bool inner_bounds_ = false;  ///< inner unknowns are moved explicitly, beside an implicit scheme
  std::unique_ptr<FreeScheme> scheme_;
  FreeMotion free_;
};

/// Throws InputError (key "scheme") where this scheme cannot move this model in steps of this control.
void checkScheme(const MotionOptions& options, const StepControl& control, const Model& model);

std::unique_ptr<Integrator> makeIntegrator(const MotionOptions& options, const Model& model, const Stage& stage,
                                           const StepControl& control, Frequency& frequency, StepWork& work);

}  // namespace gambeson
