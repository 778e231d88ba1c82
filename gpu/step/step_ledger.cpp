#include "gpu/step/step_ledger.hpp"

#include <omp.h>

#include <memory>
#include <utility>

#include "core/motion/forces.hpp"
#include "core/motion/step_audit.hpp"
#include "core/motion/step_contact.hpp"

namespace gambeson::gpu {
namespace {

constexpr std::size_t kBehind = 4;  ///< steps that the ledger may be behind the device

/// What the held points are held with at the end of a step [N], and all sums of forces there (accelerate).
/// w.spring_force is of that time.
void sumForces(const Model& m, const StepDone& done, const Vec3& air, State& s, const StepWork& w) {
  s.sums = {};
  s.sums.springs = sumOf(w.spring_force);
  s.held_N.clear();
  if (!m.held_points.empty()) {
    std::vector<Vec3> f = done.free_force;
    addStitchForces(m.stitches, m.surface.WT, s.p, f);
    for (const int i : m.held_points) {
      const Vec3 dead = m.dead_force_N.empty() ? Vec3{} : m.dead_force_N[i];
      s.held_N.push_back(-(f[i] + m.mass_kg[i] * m.environment.gravity_m_per_s2 + m.drag_kg_per_s[i] * air + dead));
      s.sums.held -= f[i];
    }
    for (std::size_t k = 0; k < m.springs.size(); ++k) {
      const int sample = m.springs[k].sample;
      for (int e = m.surface.WT.offsets[sample]; e < m.surface.WT.offsets[sample + 1]; ++e) {
        const int i = m.surface.WT.columns[e];
        if (!m.held[i]) continue;
        const Vec3 part = m.surface.WT.values[e] * w.spring_force[k];
        s.sums.springs -= part;  // taken by what holds the point
        s.held_N[heldSlot(m, i)] -= part;
      }
    }
  }
  for (int i = 0; i < m.freeCount(); ++i)
    if (!m.held[i]) s.sums.drag -= m.drag_kg_per_s[i] * (s.v[i] - air);
}

}  // namespace

void copyControl(const State& from, State& to) {
  to.time_s = from.time_s;
  to.tangled = from.tangled;
  to.pinched = from.pinched;
  to.frequency_rad_per_s = from.frequency_rad_per_s;
  to.steps_to_estimate = from.steps_to_estimate;
  to.swing = from.swing;
  to.share = from.share;
  to.last_step_s = from.last_step_s;
}

StepLedger::StepLedger(const Model& model, const gambeson::Stage& stage, StepWork& work)
    : model_(model),
      stage_(stage),
      work_(work),
      thread_(kBehind, [threads = omp_get_max_threads()] { omp_set_num_threads(threads); }) {}

void StepLedger::begin(State& state, const StepObserver& observe) {
  std::swap(state_, state);
  observe_ = &observe;
}
void StepLedger::end(State& state) {
  std::swap(state_, state);
  observe_ = nullptr;
}

void StepLedger::settle() { thread_.settle(); }

State& StepLedger::state() {
  thread_.wait();
  return state_;
}

void StepLedger::add(StepDone&& done, double dt, const State& after, const StepReport& report,
                     const Frequency& frequency) {
  auto step = std::make_shared<StepDone>(std::move(done));
  auto control = std::make_shared<State>();
  copyControl(after, *control);
  thread_.give([this, step, control, dt, report, frequency] { take(*step, dt, *control, report, frequency); });
}

void StepLedger::addByCpu(State& after, const StepReport& report, const Frequency& frequency) {
  (*observe_)(state_, after, report, work_, frequency);
  std::swap(state_, after);
}

void StepLedger::take(StepDone& done, double dt, const State& control, StepReport report, const Frequency& frequency) {
  const Model& m = model_;
  const State& in = state_;
  State& out = next_;
  StepWork& w = work_;
  StopWatch clock;
  const double half = 0.5 * dt;
  done.unpack();
  placeEnds(m, stage_, in.time_s, in.time_s + dt, w.stage);
  const Vec3 air = stage_.air(in.time_s + dt);
  const auto n = in.p.size();
  w.predictor.resize(n);
  out.p.resize(n);
  out.v.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    w.predictor[i] = in.v[i] + half * in.a[i];
    if (!in.pressed.empty()) w.predictor[i] -= half * in.pressed[i];
    out.p[i] = in.p[i] + dt * done.velocity[i];
    const Vec3 from = done.velocity[i] + half * done.pressed[i];
    out.v[i] = m.held[i] ? Vec3{} : from + half * done.acceleration[i];
  }
  std::swap(w.velocity, done.velocity);
  std::swap(out.a, done.acceleration);
  out.pressed.clear();
  if (done.presses) std::swap(out.pressed, done.pressed);
  std::swap(w.rows, done.rows);
  std::swap(w.impulses, done.impulses);
  std::swap(w.warm, done.tractions);
  w.slip.clear();
  w.impact_zones.clear();
  copyControl(control, out);
  out.anchors = in.anchors;
  out.warm.clear();     // stays on the device
  out.history.clear();  // likewise
  out.limit_J.clear();
  out.free_change.clear();
  out.elastic_J.reset();
  out.damping_W = 0;
  springForces(m, out, {w.stage.end.anchors, w.stage.end.vertices}, w.spring_force);
  sumForces(m, done, air, out, w);
  audit(dt, air, report);
  clock.lap(w.times.other);
  (*observe_)(in, out, report, w, frequency);
  std::swap(state_, next_);
}

void StepLedger::audit(double dt, const Vec3& air, StepReport& report) {
  const Model& m = model_;
  StepWork& w = work_;
  const State& in = state_;
  const AnchorFrames before{w.stage.start.anchors, w.stage.start.vertices},
      after{w.stage.end.anchors, w.stage.end.vertices};
  springForces(m, in, before, w.spring_impulses);
  for (std::size_t k = 0; k < w.spring_impulses.size(); ++k) {
    w.spring_impulses[k] = 0.5 * dt * (w.spring_impulses[k] + w.spring_force[k]);
    report.momentum.scale += norm(w.spring_impulses[k]);
  }
  report.work.supports += springWork(m, in, next_, before, after, w.spring_impulses, dt);
  if (w.audits_energy) next_.elastic_J = elasticEnergyAt(m, next_, after, w);
  auditStep(m, {in, next_, dt, stage_.air(in.time_s), air, {}, {}}, report, w);
  if (!w.audits_energy) return;
  const double before_J = in.elastic_J ? *in.elastic_J : elasticEnergyAt(m, in, before, w);
  report.work.integrator = verletWork(m, in, next_, before_J, report.work, w);
}

}  // namespace gambeson::gpu
