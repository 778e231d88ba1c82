#include <algorithm>

#include "core/motion/forces.hpp"
#include "core/motion/free_motion.hpp"
#include "core/motion/step_audit.hpp"
#include "core/motion/step_contact.hpp"

namespace gambeson {
void auditFreeStep(const Model& m, const State& in, const State& out, double dt, const FreeMotion& free,
                   double elastic_J, StepReport& report, StepWork& w) {
  const int n = m.freeCount();
  MomentumAudit& audit = report.momentum;
  WorkAudit& work = report.work;
  work.cloth += free.damping_lost_J;
  const auto internal = [&](int i) {
    return free.damping.empty() ? free.elastic[i] : free.elastic[i] + free.damping[i];
  };
  w.held_impulses.assign(m.held_points.size(), Vec3{});
  const Vec3& gravity = m.environment.gravity_m_per_s2;
  const auto dead = [&](int i) { return m.dead_force_N.empty() ? Vec3{} : m.dead_force_N[i]; };
  if (!m.supports)
    for (std::size_t k = 0; k < m.held_points.size(); ++k) {
      const int i = m.held_points[k];
      w.held_impulses[k] = -(internal(i) + free.drag[i] + dt * (m.mass_kg[i] * gravity + dead(i)));
    }
  // What forces give in a step contacts that last give back in the same: at rest they then work nothing.
  w.lasting.resize(n);
  for (int i = 0; i < n; ++i) w.lasting[i] = (1 / dt) * (free.velocity[i] - in.v[i]);
  contactLedger(m, in, dt, w.lasting, report, w);
  work.dissipated += work.cloth + free.drag_lost_J;
  work.drag += free.drag_work_J;

  // Contact's impulses on what supports take hold of, before these answer.
  std::vector<Vec3>& given = w.support_force;
  if (m.supports) {
    given.assign(n, Vec3{});
    if (!w.rows.empty()) contactImpulses(m, w, given);
  }
  double own = elastic_J + work.cloth, floor = 0;
  Vec3 held;
  std::size_t slot = 0;
  for (int i = 0; i < n; ++i) {
    const bool bound = m.supports && m.supports->binds(i);
    if (m.held[i] && !m.supports) {
      held += internal(i);
      continue;
    }
    const double mass = m.mass_kg[i];
    const Vec3 way = (1 / dt) * (out.p[i] - in.p[i]), mean = 0.5 * (in.v[i] + out.v[i]),
               lasts = dt * (mass * gravity + dead(i));
    Vec3 known = internal(i) + free.drag[i] + lasts;
    if (!free.loads.empty()) {
      known += free.loads[i];
      work.loads += dot(free.loads[i], way);
      audit.dead += free.loads[i];
      audit.scale += norm(free.loads[i]);
    }
    if (!free.missed.empty()) {
      known += free.missed[i];
      audit.missed += free.missed[i];
      audit.scale += norm(free.missed[i]);
    }
    Vec3 at_once = mass * (w.velocity[i] - w.predictor[i]);
    if (bound) {
      // What its supports do, from the equation of motion there alone.
      const Vec3 support = mass * (out.v[i] - in.v[i]) - known - given[i];
      w.held_impulses[slot++] = support;
      audit.supports += support;
      audit.scale += norm(support);
      work.supports += dot(support, way);
      at_once = given[i] + support;
    }
    own += dot(known + at_once, mean) - dot(lasts, way);
    floor += mass * (norm(out.v[i]) + kWeight_m_per_s2 * dt);
    audit.dead += dt * dead(i);
    audit.gravity += (mass * dt) * gravity;
    audit.drag += free.drag[i];
    audit.change += mass * (out.v[i] - in.v[i]);
    audit.scale += dt * norm(dead(i)) + mass * (norm(out.v[i] - in.v[i]) + dt * norm(gravity));
  }
  work.loads += innerLoadWork(m, in, out);
  for (std::size_t k = 0; k < m.inner_mass.size(); ++k)
    own += 0.5 * m.inner_mass[k] *
           (out.inner_rate[k] * out.inner_rate[k] - in.inner_rate[k] * in.inner_rate[k]);
  // Internal forces cancel: held points pass on what the springs give and the others do not get.
  audit.supports += sumOf(free.spring) - held;
  audit.scale += norm(held);
  audit.scale += norm(audit.drag);
  audit.scale = std::max(audit.scale, kScaleFloor * floor);
  work.integrator = own - (work.contact + work.drag + work.supports + work.loads);
}

}  // namespace gambeson
