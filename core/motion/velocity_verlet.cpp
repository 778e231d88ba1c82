#include "core/motion/velocity_verlet.hpp"

#include <algorithm>
#include <cmath>

#include "core/contact/penalty.hpp"
#include "core/motion/resonance.hpp"

namespace gambeson {
namespace {
/// Steps until the next estimate, times the swing: cloth that swings far changes its stiffness as far. From a swing of
/// kCrumpling on cells collapse, and one mode may take over from another between two estimates.
constexpr double kStepsAtSwing = 6, kCrumpling = 0.5;
}  // namespace

VelocityVerlet::VelocityVerlet(const Model& model, const Stage& stage, const StepControl& control, Frequency& frequency,
                               StepWork& work)
    : ControlledSteps(model, stage, control, frequency, work, FrequencyOf::all),
      pressing_rad_per_s_(penaltyFrequency(model.contact, model.density_kg_per_m2)) {}

StepReport VelocityVerlet::makeStep(const State& in, double dt, State& out) {
  return step(model_, stage_, in, dt, out, work_);
}

double VelocityVerlet::longestStep(State& state) {
  estimate(state);
  const double omega = std::max(state.frequency_rad_per_s, 1e-300);
  const double share = std::min(control_.safety, state.share > 0 ? state.share : kFirstShare);
  // Threads that do not yield take what tension a step needs of them, more the shorter it is: these say nothing.
  const double across =
      std::isfinite(model_.strain_limit.stiffness_N_per_m) ? tensionFrequency(model_.strain_rows, state.limit_J) : 0;
  return std::min(control_.max_step_s, share * 2 / std::hypot(std::hypot(omega, across), pressing_rad_per_s_));
}

double VelocityVerlet::swingOf(const State& before, const State& after, double dt, double omega) {
  return swing(model_, before, after, dt, omega, work_);
}

void VelocityVerlet::settle(const State& before, State& after, double dt, double shown2) {
  const double omega = std::max(before.frequency_rad_per_s, 1e-300);
  after.swing = std::max(swingOf(before, after, dt, omega), kSwingHeld * before.swing);
  after.share = shareAtSwing(after.swing, before.share);
  const int since = control_.estimate_every - (after.steps_to_estimate - 1);
  const bool soon = since >= kStepsAtSwing / after.swing;
  countDown(after, shown2);
  if (soon && after.steps_to_estimate >= 0) after.steps_to_estimate = after.swing > kCrumpling ? -1 : 0;
}

}  // namespace gambeson
