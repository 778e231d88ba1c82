#include "core/motion/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/motion/capacity.hpp"
#include "core/motion/step_contact.hpp"

namespace gambeson {
namespace {
constexpr int kColdIterations = 40, kWarmIterations = 8;
constexpr double kPinched = 64;  ///< part of a step below which samples count as pinched
constexpr int kMostCuts = 200, kMostRejections = 30;
constexpr double kLimitPieces = 8;  ///< a step in which strain limits and contacts do not agree is cut down to its 8th
/// Each estimate is of the stiffness at one moment. Steps that follow it up and down gain energy (a crumpled sheet
/// without drag 25 times its own in 0.4 s), so what is used stays near the largest of late.
constexpr double kFall = 0.995;
/// Of strains of laws that are an energy at a point, beyond those that the cloth has come to: the slopes of an estimate
/// hold as far, and a step that leads farther asks for another one (core/motion/DECISIONS.md).
constexpr double kStrainsAhead = 0.015;
constexpr int kSoonest = 10;  ///< steps between estimates because of the shown frequency
/// Cloth that is so many times as stiff (as a frequency) as at rest is crushed or torn: the run would need so many
/// times as many steps, and its forces mean nothing.
constexpr double kCrushed = 250;
}  // namespace

ControlledSteps::ControlledSteps(const Model& model, const Stage& stage, const StepControl& control,
                                 Frequency& frequency, StepWork& work, FrequencyOf of)
    : model_(model), stage_(stage), control_(control), frequency_(frequency), work_(work), of_(of) {
  reserve(capacityOf(model), work);
  work.audits_energy = control.audits_energy;
  has_law_strains_ = model.cloth->lawStrains(model.cloth->rest()).has_value();
}

double ControlledSteps::shownFrequency2(const State& before, const State& after) {
  double force2 = 0, way2 = 0;
  for (int i = 0; i < model_.freeCount(); ++i) {
    force2 += model_.mass_kg[i] * norm2(after.a[i] - before.a[i]);
    way2 += model_.mass_kg[i] * norm2(after.p[i] - before.p[i]);
  }
  return way2 > 0 ? std::sqrt(force2 / way2) : 0;
}

double ControlledSteps::frequencyAtRest() {
  State rest;
  for (const int home : model_.cloth->map().home) rest.p.push_back(model_.cloth->rest()[home]);
  rest.inner.resize(model_.cloth->innerValues());
  model_.cloth->startInner(rest.inner);
  return largestFrequency(model_, stage_, rest, kWarmIterations, work_, of_).largest_rad_per_s;
}

Frequency ControlledSteps::lookAtFrequency(State& state, int iterations) {
  return largestFrequency(model_, stage_, state, iterations, work_, of_);
}

/// Throws RunError where the cloth has become so stiff that something has crushed or torn it.
void ControlledSteps::refuseCrushed(State& state) {
  if (at_rest_rad_per_s_ < 0) {
    bringBack(state);
    at_rest_rad_per_s_ = frequencyAtRest();
  }
  if (at_rest_rad_per_s_ == 0 || !(state.frequency_rad_per_s > kCrushed * at_rest_rad_per_s_)) return;
  bringBack(state);
  std::size_t worst = 0;
  for (std::size_t i = 1; i < state.p.size(); ++i)
    if (norm2(state.mode[i]) > norm2(state.mode[worst])) worst = i;
  throw RunError(fmt::format(
      "time {:.6g} s: the cloth near {} is crushed or torn, so that steps would have to be {:.0f} times as short as at "
      "rest; likeliest cause: supports, obstacles or loads that leave it no room",
      state.time_s, positionText(state.p[worst]), state.frequency_rad_per_s / at_rest_rad_per_s_));
}

std::optional<StrainBox> ControlledSteps::lawStrains(const State& state) {
  q_.resize(static_cast<std::size_t>(model_.cloth->points()));
  model_.cloth->map().T.multiply<Vec3>(state.p, q_);
  return model_.cloth->lawStrains(q_);
}

void ControlledSteps::estimate(State& state) {
  if (state.steps_to_estimate > 0) return;
  if (has_law_strains_) {
    const StrainBox ahead = lawStrains(state)->widened(kStrainsAhead);
    // Never smaller: steps that follow a swing up and down gain energy.
    if (state.law_strains)
      state.law_strains->add(ahead);
    else
      state.law_strains = ahead;
  }
  const bool cold = state.frequency_rad_per_s == 0 || state.steps_to_estimate < 0;
  frequency_ = lookAtFrequency(state, cold ? kColdIterations : kWarmIterations);
  // A warm estimate may also have followed one mode while another rose.
  state.frequency_rad_per_s = std::max(frequency_.largest_rad_per_s, kFall * state.frequency_rad_per_s);
  state.steps_to_estimate = control_.estimate_every;
  refuseCrushed(state);
}

void ControlledSteps::countDown(State& after, double shown2) const {
  const double omega = std::max(after.frequency_rad_per_s, 1e-300);
  --after.steps_to_estimate;
  const int since = control_.estimate_every - after.steps_to_estimate;
  if (since >= kSoonest && shown2 > 0.8 * omega * omega) after.steps_to_estimate = -1;
}

double ControlledSteps::unstableAt(const State& end, double dt) {
  State probe = end;
  if (has_law_strains_) probe.law_strains = lawStrains(end)->widened(kStrainsAhead);
  const double omega = lookAtFrequency(probe, kColdIterations).largest_rad_per_s;
  return outruns(omega * omega, dt) ? omega : 0;
}

StepReport ControlledSteps::makeInCuts(State& state, double& dt, State& next) {
  const double whole = dt, shortest = dt / (1 << control_.max_halvings);
  for (int cuts = 0;; ++cuts) {
    if (!(state.time_s + dt > state.time_s))
      throw RunError(
          fmt::format("time {:.6g} s: a step of {:.3e} s is lost in the rounding of the time", state.time_s, dt));
    StepReport report = makeStep(state, dt, next);
    report.cuts = cuts;
    if (report.failure == StepFailure::none) {
      if (report.limit.solved || 0.5 * dt < whole / kLimitPieces) return report;
      dt *= 0.5;
      continue;
    }
    if (control_.fixed_s > 0 && report.failure == StepFailure::not_finite)
      throw RunError(
          fmt::format("time {:.6g} s, a step of {:.3e} s: {}; likeliest cause: the step is longer than the "
                      "stable one (step 0 takes that)",
                      state.time_s, dt, report.why));
    const bool impact =
        (report.failure == StepFailure::impact || report.failure == StepFailure::held) && report.earliest_impact < 1;
    if (report.failure == StepFailure::held && dt <= whole / kPinched)
      throw RunError(fmt::format("time {:.6g} s: {}", state.time_s, report.why));
    if (impact && dt <= whole / kPinched && state.pinched != work_.stuck) {
      state.pinched = work_.stuck;  // no step is short enough: let them pass, and free them afterwards
      dt = whole;
      continue;
    }
    if (dt <= shortest || cuts == kMostCuts)
      throw RunError("no step at time " + std::to_string(state.time_s) + " s, down to " + std::to_string(dt * 1e6) +
                     " us: " + report.why);
    dt *= impact ? std::clamp(0.9 * report.earliest_impact, 0.1, 0.9) : 0.5;
  }
}

bool ControlledSteps::accepts(State& state, State& next, double dt) {
  const bool fixed = control_.fixed_s > 0;
  if (fixed && !model_.collisions.self && model_.obstacles.empty()) return true;
  const double shown2 = shownFrequency2(state, next);
  if (fixed) {
    // A motion that grows and is stopped by contact grows in ever shorter steps.
    if (const double omega = outruns(shown2, dt) ? unstableAt(next, dt) : 0; omega > 0)
      throw RunError(
          fmt::format("time {:.6g} s: a step of {:.3e} s is longer than the stable one of {:.3e} s (step 0 "
                      "takes nearly that)",
                      state.time_s, dt, stableStep(omega)));
    return true;
  }
  if (const double outgrown = outruns(shown2, dt) ? unstableAt(next, dt) : 0; outgrown > 0) {
    if (++rejections_ > kMostRejections)
      throw RunError(
          fmt::format("time {:.6g} s, a step of {:.3e} s: the stable step shrinks without end; likeliest "
                      "cause: part of the cloth is crushed to nothing",
                      state.time_s, dt));
    state.frequency_rad_per_s = outgrown;
    state.pinched.clear();
    return false;
  }
  rejections_ = 0;
  settle(state, next, dt, shown2);
  if (next.law_strains && next.steps_to_estimate > 0 && !next.law_strains->contains(*lawStrains(next)))
    next.steps_to_estimate = 0;
  return true;
}

void ControlledSteps::advance(double until, State& state, const StepObserver& observe) {
  State next;
  rejections_ = 0;
  while (state.time_s < until) {
    const double longest = control_.fixed_s > 0 ? control_.fixed_s : longestStep(state);
    const double left = until - state.time_s;
    // Times are sums of steps: a fixed step that fits up to their rounding fits.
    const double pieces = std::ceil(control_.fixed_s > 0 ? left / longest - 1e-6 : left / longest * (1 - 1e-12));
    double dt = pieces <= 1 ? left : left / pieces;
    const StepReport report = makeInCuts(state, dt, next);
    if (pieces <= 1 && dt == left) next.time_s = until;
    if (!accepts(state, next, dt)) continue;
    observe(state, next, report, work_, frequency_);
    std::swap(state, next);
  }
}

}  // namespace gambeson
