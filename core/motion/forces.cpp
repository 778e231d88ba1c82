#include "core/motion/forces.hpp"

#include <cmath>

#include "core/motion/cloth_damping.hpp"
#include "core/motion/sewing.hpp"
#include "core/motion/step_audit.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {

void internalForce(const Model& m, const State& s, std::span<const double> committed, double elapsed_s,
                   std::span<double> history, std::vector<Vec3>& out, StepWork& w, ClothEnergy* energy,
                   const ForceTerms& terms) {
  w.q.resize(m.cloth->points());
  w.f.resize(m.cloth->points());
  w.inner_force.resize(m.inner_mass.size());
  out.resize(m.freeCount());
  m.cloth->map().T.multiply<Vec3>(s.p, w.q);
  m.cloth->force({w.q, s.inner, committed, {}, elapsed_s}, {w.f, w.inner_force, history, energy}, w.cloth, terms);
  m.cloth->map().Tt.multiply<Vec3>(w.f, out);
}

void leadInnerForce(const Model& m, double time_s, StepWork& w, std::vector<Vec3>& forces) {
  if (!m.supports || m.inner_mass.empty()) return;
  m.structure->loads.addInner(programValues(*m.structure, time_s, ProgramEnds::constant), w.inner_force);
  m.supports->handInner(w.inner_force, forces);
}

double innerLoadWork(const Model& m, const State& in, const State& out) {
  if (!m.supports || m.inner_mass.empty()) return 0;
  std::vector<double> load(m.inner_mass.size());
  for (const State* s : {&in, &out})
    m.structure->loads.addInner(programValues(*m.structure, s->time_s, ProgramEnds::constant), load);
  double work = 0;
  const bool turns = m.cloth->turnsInner();  // then values are no sums of what their rates did
  for (std::size_t k = 0; k < load.size(); ++k)
    work +=
        0.5 * load[k] *
        (turns ? 0.5 * (out.time_s - in.time_s) * (in.inner_rate[k] + out.inner_rate[k]) : out.inner[k] - in.inner[k]);
  return work;
}

double moveInnerRates(const Model& m, double dt, std::span<double> rates, const StepWork& w) {
  double lost = 0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    rates[i] = (rates[i] + dt * w.inner_force[i] / m.inner_mass[i]) / (1 + dt * m.inner_drag_per_s);
    lost += dt * m.inner_drag_per_s * m.inner_mass[i] * rates[i] * rates[i];
  }
  return lost;
}

void springForces(const Model& m, const State& s, const AnchorFrames& frames, std::vector<Vec3>& forces) {
  forces.resize(m.springs.size());
  for (std::size_t k = 0; k < m.springs.size(); ++k) {
    const SpringSupportPoint& spring = m.springs[k];
    const Vec3 from = sampleAt(m.surface.WT, spring.sample, s.p) - frames.of_stage[spring.anchor] * s.anchors[k],
               n = frames.normal(spring);
    forces[k] = -spring.stiffness_N_per_m * (from - dot(from, n) * n);
  }
}

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

namespace {

/// The part of `accelerate` that a structure has of its own, s.a holding the internal forces: its loads act, and its
/// supports leave (M + half D) a = F - D v to what is free. `start`: v with what lasts, less half a.
void accelerateSupported(const Model& m, const Vec3& air, const Around& around, std::vector<Vec3>& start, State& s,
                         StepWork& w) {
  const std::size_t n = s.p.size();
  // A motion starts with the velocities that supports prescribe from then on.
  const double half_step_s = around.half_step_s;
  const double t = s.time_s, dt = around.support_step_s, from = t - dt,
               to = t + (dt > 0 ? dt : 1e-6 * (1 + std::abs(t)));
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
  if (!m.sewing.empty()) {
    const std::span<const Vec3> sewn = sewAccelerations(m, half_step_s, s.a, w);
    for (const int i : m.held_points) w.support_force[i] -= sewn[i];
  }
  for (std::size_t i = 0; i < n; ++i) s.v[i] = start[i] + half_step_s * s.a[i];
  m.supports->drive(from, to, s.v);
  for (std::size_t i = 0; i < n; ++i) s.sums.drag -= m.drag_kg_per_s[i] * (s.v[i] - air);
  s.held_N.clear();
  for (const int i : m.held_points) {
    s.held_N.push_back(w.support_force[i] + m.mass_kg[i] * s.a[i] + m.drag_kg_per_s[i] * (s.v[i] - air));
    s.sums.held += s.held_N.back();
  }
}

/// The part of the seams in accelerations of worn cloth: velocities and sums follow.
void sewForces(const Model& m, double half_step_s, State& s, StepWork& w) {
  std::vector<Vec3>& before = w.start;
  before = s.a;
  const std::span<const Vec3> sewn = sewAccelerations(m, half_step_s, s.a, w);
  for (const int i : m.sewing.points()) {
    if (m.held[i]) {
      s.sums.held -= sewn[i];
      s.held_N[heldSlot(m, i)] -= sewn[i];
      continue;
    }
    const Vec3 more = half_step_s * (s.a[i] - before[i]);
    s.v[i] += more;
    s.sums.drag -= m.drag_kg_per_s[i] * more;
  }
}

}  // namespace

double accelerate(const Model& m, const AnchorFrames& anchor_frames, const Vec3& air,
                  std::span<const Vec3> half_velocity, std::span<const Vec3> lasting, const Around& around,
                  const std::vector<double>* committed, State& s, StepWork& w, ClothEnergy* energy) {
  const int n = m.freeCount();
  const double half_step_s = around.half_step_s;
  ClothEnergy of_cloth;
  const bool remembers = committed && !committed->empty();
  if (remembers) s.history.resize(committed->size());
  internalForce(m, s, remembers ? *committed : s.history, around.elapsed_s,
                remembers ? std::span<double>(s.history) : std::span<double>{}, s.a, w,
                remembers || energy ? &of_cloth : nullptr);
  if (energy) *energy = of_cloth;
  addClothDamping(m, half_velocity, s, w);
  leadInnerForce(m, s.time_s, w, s.a);
  for (std::size_t i = 0; i < m.inner_mass.size(); ++i) {
    s.inner_acceleration[i] = (w.inner_force[i] / m.inner_mass[i] - m.inner_drag_per_s * s.inner_rate[i]) /
                              (1 + m.inner_drag_per_s * half_step_s);
    s.inner_rate[i] += half_step_s * s.inner_acceleration[i];
  }
  if (m.supports) {
    w.start.resize(n);
    for (int i = 0; i < n; ++i)
      w.start[i] = lasting.empty() ? half_velocity[i] : half_velocity[i] + half_step_s * lasting[i];
    accelerateSupported(m, air, around, w.start, s, w);
    return of_cloth.lost;
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
  if (!m.sewing.empty()) sewForces(m, half_step_s, s, w);
  return of_cloth.lost;
}

double elasticEnergy(const Model& m, const State& s, const AnchorFrames& frames, double stored, StepWork& w) {
  springForces(m, s, frames, w.spring_force);
  for (std::size_t k = 0; k < m.springs.size(); ++k)
    stored += 0.5 * norm2(w.spring_force[k]) / m.springs[k].stiffness_N_per_m;
  return stored + stitchEnergy(m.stitches, m.surface.WT, s.p);
}

double elasticEnergyAt(const Model& m, const State& s, const AnchorFrames& frames, StepWork& w) {
  ClothEnergy energy;
  internalForce(m, s, s.history, 0, {}, w.sample_force, w, &energy);
  return elasticEnergy(m, s, frames, energy.stored, w);
}

void loadsAt(const Model& m, double time_s, std::span<const Vec3> q, std::vector<Vec3>& load, StepWork& w) {
  load.resize(static_cast<std::size_t>(m.freeCount()));
  w.external.assign(q.size(), Vec3{});
  m.structure->loads.add(q, programValues(*m.structure, time_s, ProgramEnds::constant), w.external);
  m.cloth->map().Tt.multiply<Vec3>(w.external, load);
}

}  // namespace gambeson
