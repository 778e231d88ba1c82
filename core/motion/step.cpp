#include "core/motion/step.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/parallel.hpp"
#include "core/motion/held_motion.hpp"
#include "core/motion/step_audit.hpp"
#include "core/motion/step_contact.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {
namespace {

/// Internal force at s on the free points, Tᵀ f(T p), into `out`, and on the inner unknowns, into work.inner_force,
/// from the committed history; what laws would remember into `history` where that is not empty.
void internalForce(const Model& m, const State& s, std::span<const double> committed, std::span<double> history,
                   std::vector<Vec3>& out, StepWork& w, ClothEnergy* energy) {
  w.q.resize(m.cloth->points());
  w.f.resize(m.cloth->points());
  w.inner_force.resize(m.inner_mass.size());
  out.resize(m.freeCount());
  m.cloth->map().T.multiply<Vec3>(s.p, w.q);
  m.cloth->force({w.q, s.inner, committed}, {w.f, w.inner_force, history, energy}, w.cloth);
  m.cloth->map().Tt.multiply<Vec3>(w.f, out);
}

/// What the springs hang on at one instant.
struct AnchorFrames {
  std::span<const Placement> of_stage;
  const DeformedVertices& vertices;

  /// Of the obstacle under the spring, unit; 0 where there is none.
  Vec3 normal(const SpringSupportPoint& spring) const {
    if (spring.obstacle < 0) return {};
    const std::span<const Vec3> x = vertices[spring.obstacle];
    const Vec3 a = x[spring.triangle[0]];
    return normalized(cross(x[spring.triangle[1]] - a, x[spring.triangle[2]] - a));
  }
};

/// The frames at an instant of no step.
struct AnchorInstant {
  std::vector<Placement> of_stage;
  DeformedVertices vertices;

  AnchorInstant(const Model& m, const Stage& stage, double time_s) : of_stage(m.anchor_count) {
    std::vector<Placement> obstacles(m.obstacles.size());
    stage.placements(time_s, obstacles, of_stage);
    for (const SpringSupportPoint& s : m.springs)
      if (s.obstacle >= 0 && vertices.empty()) vertices = deformedVertices(m, stage, time_s);
  }
  AnchorFrames frames() const { return {of_stage, vertices}; }
};

/// Forces of the springs [N]; anchors stand as `frames` say.
void springForces(const Model& m, const State& s, const AnchorFrames& frames, std::vector<Vec3>& forces) {
  forces.resize(m.springs.size());
  for (std::size_t k = 0; k < m.springs.size(); ++k) {
    const SpringSupportPoint& spring = m.springs[k];
    const Vec3 from = sampleAt(m.surface.WT, spring.sample, s.p) - frames.of_stage[spring.anchor] * s.anchors[k],
               n = frames.normal(spring);
    forces[k] = -spring.stiffness_N_per_m * (from - dot(from, n) * n);
  }
}

/// Work that the motion of anchors and normals does on the springs in a step [J]: with the energy k/2 |P d|² of the
/// displacement d, P = I - n nᵀ, it is the integral of -k (P d) . da - k (d . n) (d . dn).
double springWork(const Model& m, const State& in, const State& out, const AnchorFrames& before,
                  const AnchorFrames& after, std::span<const Vec3> impulses, double dt) {
  double work = 0;
  for (std::size_t k = 0; k < m.springs.size(); ++k) {
    const SpringSupportPoint& spring = m.springs[k];
    const Vec3 a0 = before.of_stage[spring.anchor] * in.anchors[k], a1 = after.of_stage[spring.anchor] * in.anchors[k];
    work += dot(impulses[k], a1 - a0) / dt;
    if (spring.obstacle < 0) continue;
    const Vec3 n0 = before.normal(spring), n1 = after.normal(spring),
               d0 = sampleAt(m.surface.WT, spring.sample, in.p) - a0,
               d1 = sampleAt(m.surface.WT, spring.sample, out.p) - a1;
    work -= 0.5 * spring.stiffness_N_per_m * (dot(d0, n0) * dot(d0, n1 - n0) + dot(d1, n1) * dot(d1, n1 - n0));
  }
  return work;
}

/// The part of `accelerate` that a structure has of its own, s.a holding the internal forces: its loads act, and its
/// supports leave (M + half D) a = F - D v to what is free. `start`: v with what lasts, less half a.
void accelerateSupported(const Model& m, const Vec3& air, double half_step_s, std::vector<Vec3>& start, State& s,
                         StepWork& w) {
  const std::size_t n = s.p.size();
  // A motion starts with the velocities that supports prescribe from then on.
  const double t = s.time_s, dt = 2 * half_step_s, from = t - dt, to = t + (dt > 0 ? dt : 1e-6 * (1 + std::abs(t)));
  loadsAt(m, t, w.q, w.load, w);
  m.supports->drive(from, to, start);
  w.prescribed.assign(n, Vec3{});
  m.supports->addPrescribed(t, dt, w.prescribed);
  w.support_force.resize(n);
  s.sums = {};
  for (std::size_t i = 0; i < n; ++i) {
    s.sums.loads += w.load[i];
    s.a[i] += w.load[i] + m.mass_kg[i] * m.environment.gravity_m_per_s2;
    w.support_force[i] = -s.a[i];
    s.a[i] -= m.drag_kg_per_s[i] * (start[i] - air) + m.mass_kg[i] * w.prescribed[i];
  }
  w.accelerations.resize(n);
  w.support_solver.accelerations(*m.supports, half_step_s, s.a, w.accelerations);
  s.a.swap(w.accelerations);
  for (std::size_t i = 0; i < n; ++i) s.v[i] = start[i] + half_step_s * s.a[i];
  m.supports->drive(from, to, s.v);
  for (std::size_t i = 0; i < n; ++i) s.sums.drag -= m.drag_kg_per_s[i] * (s.v[i] - air);
  s.held_N.clear();
  for (const int i : m.held_points) {
    s.held_N.push_back(w.support_force[i] + m.mass_kg[i] * s.a[i] + m.drag_kg_per_s[i] * (s.v[i] - air));
    s.sums.held += s.held_N.back();
  }
}

/// All forces at s.p; sets s.a and s.sums. `half_velocity` is v at n + 1/2 and `half_step_s` dt/2: the drag is implicit
/// there (eq. 3.13), v = half_velocity + half_step a. For an evaluation at a known velocity pass it with half_step 0.
/// With strain limits or contacts v = half_velocity + half_step (a + lasting), `lasting` being their acceleration in
/// the last step (empty: none): their force acts all the time though its impulse comes once a step, and without its
/// half cloth that hangs or lies still would have the velocity half_step a, on which drag would act.
/// `committed`: null, to evaluate at s with the history that it has; else the history that the step began with, from
/// which that of s is made. Returns what the cloth has lost in it [J].
double accelerate(const Model& m, const AnchorFrames& anchor_frames, const Vec3& air,
                  std::span<const Vec3> half_velocity, std::span<const Vec3> lasting, double half_step_s,
                  const std::vector<double>* committed, State& s, StepWork& w) {
  const int n = m.freeCount();
  ClothEnergy energy;
  const bool remembers = committed && !committed->empty();
  if (remembers) s.history.resize(committed->size());
  internalForce(m, s, remembers ? *committed : s.history,
                remembers ? std::span<double>(s.history) : std::span<double>{}, s.a, w, remembers ? &energy : nullptr);
  for (std::size_t i = 0; i < m.inner_mass.size(); ++i) {
    s.inner_acceleration[i] = w.inner_force[i] / m.inner_mass[i];
    s.inner_rate[i] += half_step_s * s.inner_acceleration[i];
  }
  if (m.supports) {
    w.start.resize(n);
    for (int i = 0; i < n; ++i)
      w.start[i] = lasting.empty() ? half_velocity[i] : half_velocity[i] + half_step_s * lasting[i];
    accelerateSupported(m, air, half_step_s, w.start, s, w);
    return energy.lost;
  }
  addStitchForces(m.stitches, m.surface.WT, s.p, s.a);
  springForces(m, s, anchor_frames, w.spring_force);
  s.sums = {};
  s.sums.springs = sumOf(w.spring_force);
  s.held_N.clear();
  const auto deadForce = [&](int i) { return m.dead_force_N.empty() ? Vec3{} : m.dead_force_N[i]; };
  for (const int i : m.held_points)
    s.held_N.push_back(
        -(s.a[i] + m.mass_kg[i] * m.environment.gravity_m_per_s2 + m.drag_kg_per_s[i] * air + deadForce(i)));
  for (std::size_t k = 0; k < m.springs.size(); ++k) {
    const int sample = m.springs[k].sample;
    for (int e = m.surface.WT.offsets[sample]; e < m.surface.WT.offsets[sample + 1]; ++e) {
      const int i = m.surface.WT.columns[e];
      const Vec3 f = m.surface.WT.values[e] * w.spring_force[k];
      if (m.held[i]) {
        s.sums.springs -= f;  // taken by what holds the point
        s.held_N[heldSlot(m, i)] -= f;
      } else {
        s.a[i] += f;
      }
    }
  }
  for (int i = 0; i < n; ++i) {
    if (m.held[i]) {
      s.sums.held -= s.a[i];
      s.a[i] = {};
      s.v[i] = {};
      continue;
    }
    const double d = m.drag_kg_per_s[i];
    const Vec3 start = lasting.empty() ? half_velocity[i] : half_velocity[i] + half_step_s * lasting[i];
    Vec3 f = s.a[i] + m.mass_kg[i] * m.environment.gravity_m_per_s2 - d * (start - air);
    if (!m.dead_force_N.empty()) f += m.dead_force_N[i];
    s.a[i] = f / (m.mass_kg[i] + d * half_step_s);
    s.v[i] = start + half_step_s * s.a[i];
    s.sums.drag -= d * (s.v[i] - air);
  }
  return energy.lost;
}

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

void loadsAt(const Model& m, double time_s, std::span<const Vec3> q, std::vector<Vec3>& load, StepWork& w) {
  load.resize(static_cast<std::size_t>(m.freeCount()));
  w.external.assign(q.size(), Vec3{});
  m.structure->loads.add(q, programValues(*m.structure, time_s, ProgramEnds::constant), w.external);
  m.cloth->map().Tt.multiply<Vec3>(w.external, load);
}

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
  accelerate(model, at.frames(), stage.air(state.time_s), v, {}, 0, nullptr, state, work);
  findHeldMotions(model, stage, state.time_s, state.time_s, work);
  rateHeld(model, state.p, work, state.v);
}

void evaluateForces(const Model& model, const Stage& stage, State& state, StepWork& work) {
  const AnchorInstant at(model, stage, state.time_s);
  const std::vector<Vec3> v = state.v;
  accelerate(model, at.frames(), stage.air(state.time_s), v, {}, 0, nullptr, state, work);
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
  report.work.cloth = accelerate(m, after, air1, w.velocity, together(w.pulled_after, out.pressed, w.lasting), half,
                                 &in.history, out, w);
  report.work.dissipated += report.work.cloth;
  rateHeld(m, out.p, w, out.v);
  if (!allFinite(out.v)) return notFinite("a force is not finite");
  for (std::size_t k = 0; k < spring_mean.size(); ++k) {
    spring_mean[k] = half * (spring_mean[k] + w.spring_force[k]);
    report.momentum.scale += norm(spring_mean[k]);
  }
  report.work.supports += springWork(m, in, out, before, after, spring_mean, dt);

  clock.lap(w.times.force);
  keepWarm(m, dt, w, out.warm);
  // Cloth wholly inside of a mesh crosses nothing until it comes out.
  out.tangled = report.intersections > 0 || report.pinched > 0 || report.inside > 0;
  out.pinched.clear();
  out.frequency_rad_per_s = in.frequency_rad_per_s;
  out.mode = in.mode;
  out.steps_to_estimate = in.steps_to_estimate;
  out.swing = in.swing;
  out.share = in.share;
  out.last_step_s = dt;

  auditStep(m, {in, out, dt, air0, air1, held_before, held_after}, report, w);
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
  internalForce(m, s, s.history, {}, w.sample_force, w, &of_cloth);
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
