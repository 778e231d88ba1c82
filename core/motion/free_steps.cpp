#include "core/motion/free_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/motion/velocity_verlet.hpp"

namespace gambeson {
namespace {

/// Steps of implicit schemes are long: what their inner unknowns and bending allow is looked at more often.
constexpr int kLongStepsToEstimate = 10;

RungeKuttaOrder orderOf(MotionScheme s) {
  return s == MotionScheme::euler              ? RungeKuttaOrder::euler
         : s == MotionScheme::symplectic_euler ? RungeKuttaOrder::symplectic
         : s == MotionScheme::midpoint         ? RungeKuttaOrder::midpoint
                                               : RungeKuttaOrder::fourth;
}

FrequencyOf frequencyOf(MotionScheme s) {
  return s == MotionScheme::implicit_euler  ? FrequencyOf::inner
         : s == MotionScheme::semi_implicit ? FrequencyOf::bending
                                            : FrequencyOf::all;
}

StepControl controlOf(MotionScheme s, StepControl control) {
  if (isImplicit(s)) control.estimate_every = std::min(control.estimate_every, kLongStepsToEstimate);
  return control;
}

std::unique_ptr<FreeScheme> schemeOf(const MotionOptions& o) {
  if (!isImplicit(o.scheme)) return std::make_unique<RungeKutta>(orderOf(o.scheme));
  return std::make_unique<ImplicitVelocities>(
      ImplicitVelocityOptions{o.scheme == MotionScheme::semi_implicit ? o.substeps : 0, o.solve_tolerance});
}

/// The least rate at which drag takes the velocity of a point that moves [1/s].
double leastDamping(const Model& m) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < m.freeCount(); ++i)
    if (!m.held[i]) least = std::min(least, m.drag_kg_per_s[i] / m.mass_kg[i]);
  return least;
}

}  // namespace

void checkScheme(const MotionOptions& o, const StepControl& control, const Model& m) {
  if (!m.sewing.empty() && o.scheme != MotionScheme::verlet)
    throw InputError({"", 0, "scheme"}, "sewn seams are projected in steps of velocity Verlet; allowed with them: verlet");
  if (o.scheme == MotionScheme::verlet) return;
  if (m.strain_limit.mode != LimitMode::none)
    throw InputError({"", 0, "scheme"}, "strain limits go with velocity Verlet");
  if ((o.scheme == MotionScheme::euler || o.scheme == MotionScheme::midpoint) && !(control.fixed_s > 0) &&
      !(leastDamping(m) > 0))
    throw InputError({"", 0, "scheme"},
                     "lets motion grow in steps of any length where nothing damps it; allowed: with drag, or with a "
                     "given step");
}

FreeSteps::FreeSteps(const Model& model, const Stage& stage, const MotionOptions& options, const StepControl& control,
                     Frequency& frequency, StepWork& work)
    : ControlledSteps(model, stage, controlOf(options.scheme, control), frequency, work, frequencyOf(options.scheme)),
      options_(options),
      damping_per_s_(leastDamping(model)),
      scheme_(schemeOf(options)) {
  checkScheme(options, control, model);
  inner_bounds_ = options.scheme == MotionScheme::implicit_euler && !model.inner_mass.empty() &&
                  model.cloth->tangent()->sparsity().rows() == model.freeCount();
}

StepReport FreeSteps::makeStep(const State& in, double dt, State& out) {
  return freeStep(model_, stage_, *scheme_, in, dt, out, free_, work_);
}

double FreeSteps::stableStep(double omega) const {
  switch (options_.scheme) {
    case MotionScheme::implicit_euler:
      return 2 / omega;
    case MotionScheme::semi_implicit:
      return options_.substeps * 2 / omega;
    default:
      return longestStableStep(orderOf(options_.scheme), omega, damping_per_s_);
  }
}

double FreeSteps::longestStep(State& state) {
  if (options_.scheme == MotionScheme::implicit_euler && !inner_bounds_) return control_.max_step_s;
  estimate(state);
  return std::min(control_.max_step_s,
                  control_.safety * stableStep(std::max(state.frequency_rad_per_s, 1e-300)));
}

bool FreeSteps::outruns(double omega2, double dt) const {
  if (isImplicit(options_.scheme)) return false;  // what the motion shows is not what bounds the step
  if (options_.scheme == MotionScheme::runge_kutta) return omega2 * dt * dt > 8;
  if (options_.scheme == MotionScheme::symplectic_euler) return omega2 * dt * dt > 4;
  return control_.fixed_s > 0 ? omega2 * dt * dt > 1 : dt > stableStep(std::sqrt(omega2));
}

void FreeSteps::settle(const State&, State& after, double, double shown2) {
  countDown(after, isImplicit(options_.scheme) ? 0 : shown2);
}

std::unique_ptr<Integrator> makeIntegrator(const MotionOptions& options, const Model& model, const Stage& stage,
                                           const StepControl& control, Frequency& frequency, StepWork& work) {
  if (options.scheme == MotionScheme::verlet)
    return std::make_unique<VelocityVerlet>(model, stage, control, frequency, work);
  return std::make_unique<FreeSteps>(model, stage, options, control, frequency, work);
}

}  // namespace gambeson
