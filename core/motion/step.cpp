#include "core/motion/step.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/parallel.hpp"
#include "core/motion/cloth_damping.hpp"
#include "core/motion/forces.hpp"
#include "core/motion/held_motion.hpp"
#include "core/motion/sewing.hpp"
#include "core/motion/step_audit.hpp"
#include "core/motion/step_contact.hpp"

namespace gambeson {
namespace {

/// Accelerations - M^-1 J^T lambda of the strain limits at s [m/s^2], and their forces on held points [N]. Empty where
/// nothing pulls.
std::vector<Vec3> limitAccelerations(const Model& m, const State& s, std::vector<Vec3>& out, LimitWork& w) {
  out.clear();
  if (s.limit_J.empty()) return {};
  strainVectors(m.strain_rows, s.p, w.e);
  for (std::size_t i = 0; i < w.e.size(); ++i) w.e[i] *= s.limit_J[i];
  out.resize(m.freeCount());
  m.strain_rows.Bt.multiply<Vec3>(w.e, out);
  std::vector<Vec3> held;
  for (const int i : m.held_points) held.push_back(-out[i]);
  if (m.supports) {
    const std::vector<Vec3> pull = out;
    applyMobility(m.strain_rows.mobility, pull, out);
    for (Vec3& a : out) a = -a;
    return held;
  }
  for (int i = 0; i < m.freeCount(); ++i) out[i] *= -m.inverse_mass[i];
  return held;
}

/// The accelerations of limits and contacts together.
std::span<const Vec3> together(std::span<const Vec3> pulled, std::span<const Vec3> pressed, std::vector<Vec3>& sum) {
  if (pulled.empty()) return pressed;
  if (pressed.empty()) return pulled;
  sum.resize(pulled.size());
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = pulled[i] + pressed[i];
  return sum;
}

}  // namespace

void samplePositions(const Model& model, std::span<const Vec3> p, std::vector<Vec3>& x) {
  x.resize(model.surface.size());
  model.surface.WT.multiply<Vec3>(p, x);
}

State initialState(const Model& model, const Stage& stage, double time_s, StepWork& work) {
  State s;
  s.time_s = time_s;
  for (int home : model.cloth->map().home) s.p.push_back(model.cloth->rest()[home]);
  s.v.assign(s.p.size(), {});
  if (model.supports) model.supports->place(time_s, s.p);
  s.history.resize(model.cloth->historySize());
  model.cloth->startHistory(s.history);
  s.inner.resize(model.cloth->innerValues());
  model.cloth->startInner(s.inner);
  if (model.supports) model.supports->placeInner(time_s, s.p, s.inner);
  s.inner_rate.assign(model.inner_mass.size(), 0);
  s.inner_acceleration.assign(model.inner_mass.size(), 0);
  attachSprings(model, stage, s, work);
  return s;
}

void attachSprings(const Model& model, const Stage& stage, State& state, StepWork& work) {
  const AnchorInstant at(model, stage, state.time_s);
  std::vector<Vec3> anchors;
  for (std::size_t k = 0; k < model.springs.size(); ++k) {
    const SpringSupportPoint& spring = model.springs[k];
    anchors.push_back(toLocal(at.of_stage[spring.anchor],
                              sampleAt(model.surface.WT, spring.sample, state.p) + model.spring_rise_m[k]));
  }
  hangSprings(model, stage, anchors, state, work);
}

void hangSprings(const Model& model, const Stage& stage, std::span<const Vec3> anchors, State& state, StepWork& work) {
  const AnchorInstant at(model, stage, state.time_s);
  state.anchors.assign(anchors.begin(), anchors.end());
  const std::vector<Vec3> v = state.v;
  state.limit_J.clear();
  state.pressed.clear();
  state.elastic_J.reset();
  state.free_change.clear();
  accelerate(model, at.frames(), stage.air(state.time_s), v, {}, {}, nullptr, state, work);
  state.damping_W = clothDampingPower(state, work);
  findHeldMotions(model, stage, state.time_s, state.time_s, work);
  rateHeld(model, state.p, work, state.v);
}

void evaluateForces(const Model& model, const Stage& stage, State& state, StepWork& work) {
  const AnchorInstant at(model, stage, state.time_s);
  const std::vector<Vec3> v = state.v;
  accelerate(model, at.frames(), stage.air(state.time_s), v, {}, {}, nullptr, state, work);
  state.damping_W = clothDampingPower(state, work);
  findHeldMotions(model, stage, state.time_s, state.time_s, work);
  rateHeld(model, state.p, work, state.v);
}

StepReport step(const Model& m, const Stage& stage, const State& in, double dt, State& out, StepWork& w) {
  const int n = m.freeCount();
  const double half = 0.5 * dt;
  StepReport report;
  report.step_s = dt;
  StopWatch clock, whole;
  placeStage(m, stage, in.time_s, in.time_s + dt, w.stage);
  const Vec3 air0 = stage.air(in.time_s), air1 = stage.air(in.time_s + dt);
  clock.lap(w.times.stage);

  // 1.1 Predictor, eq. 3.11.
  w.predictor.resize(n);
  const std::vector<Vec3> held_before = limitAccelerations(m, in, w.pulled_before, w.limit);
  for (int i = 0; i < n; ++i) w.predictor[i] = in.v[i] + half * in.a[i];
  const std::span<const Vec3> lasted = together(w.pulled_before, in.pressed, w.lasting);
  if (!lasted.empty())
    for (int i = 0; i < n; ++i) w.predictor[i] -= half * lasted[i];  // this step's impulses come in its place
  if (m.supports) m.supports->drive(in.time_s, in.time_s + dt, w.predictor);
  findHeldMotions(m, stage, in.time_s, in.time_s + dt, w);
  driveHeld(m, in.p, dt, w, w.predictor);
  if (!m.sewing.empty()) sewVelocities(m, in.p, dt, w);
  const auto notFinite = [&](const char* what) {
    report.failure = StepFailure::not_finite;
    report.why = what;
    return report;
  };
  if (!allFinite(w.predictor)) return notFinite("a velocity is not finite");

  // 1.2 Contact and impact, eq. 3.12.
  samplePositions(m, in.p, w.x0);
  if (!resolveContacts(m, in, dt, report, clock, w)) return report;

  // 1.2 continued: positions; 2. acceleration and velocity, eq. 3.13.
  out.time_s = in.time_s + dt;
  out.p.resize(n);
  out.v.resize(n);
  for (int i = 0; i < n; ++i) out.p[i] = in.p[i] + dt * w.velocity[i];
  if (m.supports) m.supports->place(out.time_s, out.p);
  placeHeld(m, in.p, w, out.p);
  if (!allFinite(out.p)) return notFinite("a position is not finite");
  out.inner_rate = in.inner_rate;
  for (std::size_t i = 0; i < out.inner_rate.size(); ++i) out.inner_rate[i] += half * in.inner_acceleration[i];
  out.inner.resize(in.inner.size());
  m.cloth->advance(in.inner, out.inner_rate, dt, out.inner);
  if (m.supports) m.supports->placeInner(out.time_s, out.p, out.inner);
  out.inner_acceleration.resize(out.inner_rate.size());
  samplePositions(m, out.p, w.x1);
  const int samples = m.surface.size();
  report.largest_way =
      largestOf(Each::value, samples, 0.0, [&](int s) { return norm(w.x1[s] - w.x0[s]) / m.cell_m[s]; });
  clock.lap(w.times.other);
  out.anchors = in.anchors;
  std::vector<Vec3>& spring_mean = w.spring_impulses;
  const AnchorFrames before{w.stage.start.anchors, w.stage.start.vertices},
      after{w.stage.end.anchors, w.stage.end.vertices};
  springForces(m, in, before, spring_mean);
  out.limit_J.clear();
  if (m.strain_limit.mode != LimitMode::none) limitMultipliers(m.strain_rows, out.p, dt, out.limit_J, w.limit);
  const std::vector<Vec3> held_after = limitAccelerations(m, out, w.pulled_after, w.limit);
  pressingAccelerations(m, dt, w, out.pressed);
  out.history.clear();
  ClothEnergy energy;
  const double lost = accelerate(m, after, air1, w.velocity, together(w.pulled_after, out.pressed, w.lasting),
                                 {half, dt, dt}, &in.history, out, w, w.audits_energy ? &energy : nullptr);
  out.damping_W = clothDampingPower(out, w);
  report.work.cloth = lost + half * (in.damping_W + out.damping_W);
  report.work.dissipated += lost + dt * w.damping_power_W;
  rateHeld(m, out.p, w, out.v);
  if (!allFinite(out.v)) return notFinite("a force is not finite");
  for (std::size_t k = 0; k < spring_mean.size(); ++k) {
    spring_mean[k] = half * (spring_mean[k] + w.spring_force[k]);
    report.momentum.scale += norm(spring_mean[k]);
  }
  report.work.supports += springWork(m, in, out, before, after, spring_mean, dt);

  clock.lap(w.times.force);
  leaveToNext(m, in, dt, report, w, out);
  out.free_change.clear();
  out.elastic_J.reset();
  if (w.audits_energy) out.elastic_J = elasticEnergy(m, out, after, energy.stored, w);

  auditStep(m, {in, out, dt, air0, air1, held_before, held_after}, report, w);
  if (w.audits_energy) {
    const double before_J = in.elastic_J ? *in.elastic_J : elasticEnergyAt(m, in, before, w);
    report.work.integrator = verletWork(m, in, out, before_J, report.work, w);
  }
  clock.lap(w.times.other);
  if (report.searched) {
    ++w.times.searches;
    whole.lap(w.times.searched_steps);
  }
  return report;
}

Energy energyOf(const Model& m, const Stage& stage, const State& s, StepWork& w) {
  Energy e;
  ClothEnergy of_cloth;
  internalForce(m, s, s.history, 0, {}, w.sample_force, w, &of_cloth);
  e.internal = of_cloth.stored;
  for (std::size_t i = 0; i < m.inner_mass.size(); ++i)
    e.kinetic += 0.5 * m.inner_mass[i] * s.inner_rate[i] * s.inner_rate[i];
  for (int i = 0; i < m.freeCount(); ++i) {
    if (m.held[i]) continue;
    e.kinetic += 0.5 * m.mass_kg[i] * norm2(s.v[i]);
    e.gravity -= m.mass_kg[i] * dot(m.environment.gravity_m_per_s2, s.p[i]);
    if (!m.dead_force_N.empty()) e.dead -= dot(m.dead_force_N[i], s.p[i]);
  }
  springForces(m, s, AnchorInstant(m, stage, s.time_s).frames(), w.spring_force);
  for (std::size_t k = 0; k < m.springs.size(); ++k)
    e.springs += 0.5 * norm2(w.spring_force[k]) / m.springs[k].stiffness_N_per_m;
  e.springs += stitchEnergy(m.stitches, m.surface.WT, s.p);
  return e;
}

}  // namespace gambeson
