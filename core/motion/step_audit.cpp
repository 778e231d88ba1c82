#include "core/motion/step_audit.hpp"

#include <algorithm>

#include "core/math/parallel.hpp"
#include "core/motion/forces.hpp"
#include "core/motion/sewing.hpp"
#include "core/motion/step_contact.hpp"
#include "core/motion/step_method.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {
namespace {

/// Work beyond that of its impulse I on the mean velocity u = (predictor + velocity)/2 - half a of a force that acts
/// all the time though its impulse comes once a step [J]. With its accelerations c0 and c1 at the ends of the step, I =
/// J + 2 half m c0: half m (c0 + c1) acts as the other forces do, on the way of the step, and J, what was not foreseen,
/// at once on u; at rest both are nothing. `before`, `after`: empty or the accelerations.
double lastingWork(const Model& m, std::span<const Vec3> before, std::span<const Vec3> after, const State& in,
                   double half, const StepWork& w) {
  double work = 0;
  for (int i = 0; i < m.freeCount(); ++i) {
    const Vec3 c0 = before.empty() ? Vec3{} : before[i], c1 = after.empty() ? Vec3{} : after[i];
    work += (half * m.mass_kg[i]) *
            (dot(c0 + c1, w.velocity[i]) - dot(c0, w.predictor[i] + w.velocity[i] - (2 * half) * in.a[i]));
  }
  return work;
}

/// What an impulse on these samples works on, as the ledger has it (contactLedger).
Vec3 meanVelocity(const SparseRows& WT, const Stencil& stencil, double dt, std::span<const Vec3> foreseen,
                  const StepWork& w) {
  Vec3 mean{};
  for (int j = 0; j < stencil.count; ++j) {
    const int s = stencil.sample[j];
    mean += (0.5 * stencil.weight[j]) * (foreseen.empty() ? sampleAt(WT, s, w.predictor) + sampleAt(WT, s, w.velocity)
                                                          : sampleAt(WT, s, w.predictor) + sampleAt(WT, s, w.velocity) -
                                                                dt * sampleAt(WT, s, foreseen));
  }
  return mean;
}

}  // namespace

void contactLedger(const Model& m, const State& in, double dt, std::span<const Vec3> foreseen, StepReport& report,
                   StepWork& w) {
  w.contact_impulses.clear();
  const SparseRows& WT = m.surface.WT;
  w.row_mean.resize(w.rows.size());
  forAll(Each::sum, static_cast<int>(w.rows.size()), [&](int i) {
    if (!(w.impulses[i] == Vec3{})) w.row_mean[i] = meanVelocity(WT, w.rows[i].stencil, dt, foreseen, w);
  });
  for (std::size_t i = 0; i < w.rows.size(); ++i) {
    const ContactRow& row = w.rows[i];
    const Vec3& impulse = w.impulses[i];
    if (impulse == Vec3{}) continue;
    const Contact& c = row.contact;
    const bool body = c.onBody();
    const Vec3& mean = w.row_mean[i];
    for (int j = 0; j < row.stencil.count; ++j) {
      const int s = row.stencil.sample[j];
      const Vec3 part = row.stencil.weight[j] * impulse;
      if (body)
        w.contact_impulses.push_back(
            {s, c.obstacle, c.feature, part, c.normal, w.stage.start.obstacles[c.obstacle] * c.local, c.touched});
      if (body) report.momentum.obstacles -= part;
      for (int k = WT.offsets[s]; k < WT.offsets[s + 1]; ++k)
        if (const int point = WT.columns[k]; !m.supports && m.held[point]) {
          report.momentum.supports -= WT.values[k] * part;
          w.held_impulses[heldSlot(m, point)] -= WT.values[k] * part;
        }
    }
    report.momentum.scale += norm(impulse);
    const double normal = dot(impulse, c.normal);
    report.work.contact += dot(impulse, mean);
    if (row.slippery) report.work.restoring += dot(impulse, mean);
    report.work.friction += dot(impulse - normal * c.normal, mean);
    const double separation =
        !row.slippery && c.gap_m < layerOf(m, row) && row.target_m_per_s > 0 ? normal * row.target_m_per_s : 0;
    report.work.separation += separation;
    const Vec3 lost = givesBack(m, row) ? impulse - normal * c.normal : impulse;
    if (!row.slippery) report.work.dissipated += separation - dot(lost, mean - row.body_velocity);
  }
  // What impact zones take from the cloth goes to what they move with.
  for (int z = 0; z < w.impact_zones.size(); ++z) {
    const ImpactZone zone = w.impact_zones[z];
    std::vector<std::size_t> held;
    for (int i : zone.points)
      if (takesHold(m, i)) held.push_back(heldSlot(m, i));
    Vec3 with{};  // the velocity of what supports move in it
    const bool guided = zone.body < 0 && !held.empty() && !m.held_motion.empty();
    if (guided)
      for (const std::size_t k : held) with += w.velocity[m.held_points[k]] / static_cast<double>(held.size());
    for (int i : zone.points) {
      if (takesHold(m, i)) continue;
      const Vec3 impulse = m.mass_kg[i] * w.impact_zone_change[i];
      report.work.contact += dot(impulse, w.velocity[i] - 0.5 * w.impact_zone_change[i] - with);
      report.work.dissipated +=
          0.5 * dot(impulse, w.impact_zone_change[i]) - (zone.body < 0 && !guided ? dot(impulse, w.velocity[i]) : 0);
      report.momentum.scale += norm(impulse);
      if (zone.body >= 0) {
        const Vec3 point = in.p[i];
        const int sample = m.surface.WTt.columns[m.surface.WTt.offsets[i]];
        const double size = norm(impulse);
        if (size == 0) continue;
        w.contact_impulses.push_back(
            {sample, zone.body, 0, impulse, impulse / size, point, nearestTouched(m, zone, point, w)});
        report.momentum.obstacles -= impulse;
      } else if (!held.empty()) {
        report.momentum.supports += impulse;
        for (const std::size_t k : held) w.held_impulses[k] += impulse / static_cast<double>(held.size());
      }
    }
  }
}

namespace {

/// What supports do to what they take hold of, from the equation of motion there alone; and all loads. All points have
/// a part in the momentum.
void auditSupports(const Model& m, const StepEnds& e, StepReport& report, StepWork& w) {
  const State &in = e.in, &out = e.out;
  const double half = 0.5 * e.step_s;
  MomentumAudit& audit = report.momentum;
  w.q.resize(m.cloth->points());
  m.cloth->map().T.multiply<Vec3>(in.p, w.q);
  loadsAt(m, in.time_s, w.q, w.load_before, w);
  // Impulses at once: of contacts and limits.
  const int n = m.freeCount();
  std::vector<Vec3>& given = w.support_force;
  given.assign(n, Vec3{});
  if (!w.rows.empty()) contactImpulses(m, w, given);
  if (m.strain_limit.mode != LimitMode::none)
    for (int i = 0; i < n; ++i) given[i] -= w.limit.pull[i] / e.step_s;
  if (!m.sewing.empty())
    for (const int i : m.sewing.points()) given[i] += w.sewn_impulse[i];
  const auto ahead = [&](int i) {  // of the next impulses, in the velocities
    Vec3 d{};
    if (!w.pulled_after.empty()) d += half * w.pulled_after[i];
    if (!w.pulled_before.empty()) d -= half * w.pulled_before[i];
    audit.supports += m.mass_kg[i] * d;  // of all points, of limits
    if (!out.pressed.empty()) d += half * out.pressed[i];
    if (!in.pressed.empty()) d -= half * in.pressed[i];
    return d;
  };
  std::vector<Vec3>& change = w.external;
  change.resize(n);
  for (int i = 0; i < n; ++i) change[i] = out.v[i] - in.v[i] - half * (in.a[i] + out.a[i]) - ahead(i);
  for (std::size_t k = 0; k < m.held_points.size(); ++k) {
    const int i = m.held_points[k];
    const Vec3 at_once = m.mass_kg[i] * change[i] - given[i], lasting = half * (in.held_N[k] + out.held_N[k]);
    w.held_impulses[k] += at_once;
    audit.supports += at_once;
    audit.scale += norm(at_once);
    const Vec3 way = out.p[i] - in.p[i];
    report.work.supports += dot(lasting + at_once, way) / e.step_s;
  }
  for (int i = 0; i < n; ++i) report.work.loads += 0.5 * dot(w.load_before[i] + w.load[i], out.p[i] - in.p[i]);
  report.work.loads += innerLoadWork(m, in, out);
  audit.dead = half * (in.sums.loads + out.sums.loads);
  audit.scale += norm(audit.dead);
}

/// Of held points that supports move, w.held_impulses being what keeps them still: its work on the cloth around them,
/// which is without their own weight and drag; and what their inertia and drag ask for beside.
void auditHeldMotion(const Model& m, const StepEnds& e, StepReport& report, StepWork& w) {
  const double half = 0.5 * e.step_s;
  for (std::size_t k = 0; k < m.held_motion.size(); ++k) {
    if (m.held_motion[k] < 0) continue;
    const int i = m.held_points[k];
    const double d = m.drag_kg_per_s[i];
    Vec3 own = m.mass_kg[i] * m.environment.gravity_m_per_s2 + 0.5 * d * (e.air_before + e.air_after);
    if (!m.dead_force_N.empty()) own += m.dead_force_N[i];
    report.work.supports += dot(w.held_impulses[k] + e.step_s * own, (e.out.p[i] - e.in.p[i]) / e.step_s);
    w.held_impulses[k] += m.mass_kg[i] * (e.out.v[i] - e.in.v[i]) + half * d * (e.in.v[i] + e.out.v[i]);
  }
}

/// What seams give in a step: where they close, and under contact. While they close, their force does work (that at the
/// end stands for the step), and so does what they give under contact.
void auditSewing(const Model& m, const StepEnds& e, double dt, StepReport& report, StepWork& w) {
  constexpr double kCloses_m_per_s = 1e-4;
  const State &in = e.in, &out = e.out;
  report.work.supports += sewingWork(m, dt, in.a, in.p, out.p, w);
  for (const int i : m.sewing.points()) report.work.supports += dot(w.sewn_force[i], out.p[i] - in.p[i]);
  const bool closes = std::any_of(w.sewn_rates.begin(), w.sewn_rates.end(),
                                  [](const Vec3& rate) { return norm(rate) > kCloses_m_per_s; });
  w.sewn_impulse = w.sewn_closing;
  for (const Vec3& impulse : w.sewn_impulse) report.momentum.scale += norm(impulse);
  if (!w.rows.empty() && (closes || !m.held_points.empty()) && someSeamsHold(w)) {
    std::vector<Vec3> impulses(static_cast<std::size_t>(m.freeCount()));
    contactImpulses(m, w, impulses);
    addSeamsUnderContact(m, impulses, w);
    if (closes)
      for (const int i : m.sewing.points())
        report.work.supports += dot(w.sewn_impulse[i] - w.sewn_closing[i], out.p[i] - in.p[i]) / dt;
  }
  if (m.supports) return;  // auditSupports has them
  for (std::size_t k = 0; k < m.held_points.size(); ++k) {
    const Vec3& impulse = w.sewn_impulse[m.held_points[k]];
    report.momentum.supports -= impulse;
    w.held_impulses[k] -= impulse;
  }
}

}  // namespace

void auditStep(const Model& m, const StepEnds& e, StepReport& report, StepWork& w) {
  const State &in = e.in, &out = e.out;
  const double dt = e.step_s, half = 0.5 * dt;
  const int n = m.freeCount();
  MomentumAudit& audit = report.momentum;
  w.held_impulses.assign(m.held_points.size(), Vec3{});
  for (std::size_t k = 0; k < w.held_impulses.size(); ++k) w.held_impulses[k] = half * (in.held_N[k] + out.held_N[k]);
  contactLedger(m, in, dt, in.a, report, w);
  if (!m.sewing.empty()) auditSewing(m, e, dt, report, w);
  if (m.supports) auditSupports(m, e, report, w);
  if (m.strain_limit.mode != LimitMode::none && m.supports) {
    for (int i = 0; i < n; ++i)
      report.work.limit -= (0.5 / dt) * dot(w.limit.pull[i], w.predictor[i] + w.velocity[i] - dt * in.a[i]);
    report.work.limit += lastingWork(m, w.pulled_before, w.pulled_after, in, half, w);
  } else if (m.strain_limit.mode != LimitMode::none) {
    const Vec3 pull_after = sumOf(e.held_after), pull_before = sumOf(e.held_before);
    audit.supports -= half * (pull_after - pull_before);
    audit.scale += half * (norm(pull_after) + norm(pull_before));
    for (std::size_t k = 0; k < w.held_impulses.size(); ++k) {
      w.held_impulses[k] += w.limit.pull[m.held_points[k]] / dt;
      if (!e.held_after.empty()) w.held_impulses[k] -= half * e.held_after[k];
      if (!e.held_before.empty()) w.held_impulses[k] += half * e.held_before[k];
    }
    for (int i = 0; i < n; ++i) {
      const Vec3 impulse = -w.limit.pull[i] / dt;
      if (m.held[i]) {
        audit.supports -= impulse;
        audit.scale += norm(impulse);
        if (!m.held_motion.empty()) report.work.limit += dot(impulse, w.velocity[i]);
        continue;
      }
      report.work.limit += 0.5 * dot(impulse, w.predictor[i] + w.velocity[i] - dt * in.a[i]);
    }
    report.work.limit += lastingWork(m, w.pulled_before, w.pulled_after, in, half, w);
  }
  auditHeldMotion(m, e, report, w);
  if (!in.pressed.empty() || !out.pressed.empty()) {
    report.work.contact += lastingWork(m, in.pressed, out.pressed, in, half, w);
    for (int i = 0; i < n; ++i) {
      if (!out.pressed.empty()) audit.pressing += (m.mass_kg[i] * half) * out.pressed[i];
      if (!in.pressed.empty()) audit.pressing -= (m.mass_kg[i] * half) * in.pressed[i];
    }
    audit.scale += norm(audit.pressing);
  }
  double floor = 0;
  for (int i = 0; i < n; ++i) {
    if (m.held[i] && !m.supports) continue;
    floor += m.mass_kg[i] * (norm(out.v[i]) + kWeight_m_per_s2 * dt);
    if (!m.dead_force_N.empty()) {
      audit.dead += dt * m.dead_force_N[i];
      audit.scale += dt * norm(m.dead_force_N[i]);
    }
    audit.change += m.mass_kg[i] * (out.v[i] - in.v[i]);
    audit.scale += m.mass_kg[i] * norm(out.v[i] - in.v[i]);  // internal forces cancel in the sum, not in its rounding
    audit.gravity += (m.mass_kg[i] * dt) * m.environment.gravity_m_per_s2;
    audit.scale += m.mass_kg[i] * dt * norm(m.environment.gravity_m_per_s2);
    const double d = m.drag_kg_per_s[i];
    const Vec3 &v0 = in.v[i], &v1 = out.v[i];
    report.work.drag -= half * d * (dot(v0 - e.air_before, v0) + dot(v1 - e.air_after, v1));
    report.work.dissipated += half * d * (norm2(v0 - e.air_before) + norm2(v1 - e.air_after));
  }
  for (std::size_t k = 0; k < m.inner_mass.size(); ++k) {
    const double lost = half * m.inner_drag_per_s * m.inner_mass[k] *
                        (in.inner_rate[k] * in.inner_rate[k] + out.inner_rate[k] * out.inner_rate[k]);
    report.work.drag -= lost;
    report.work.dissipated += lost;
  }
  audit.drag = half * (in.sums.drag + out.sums.drag);
  audit.supports += half * (in.sums.springs + in.sums.held + out.sums.springs + out.sums.held);
  audit.scale += norm(audit.drag) + half * (norm(in.sums.held) + norm(out.sums.held));
  audit.scale = std::max(audit.scale, kScaleFloor * floor);
}

double verletWork(const Model& m, const State& in, const State& out, double elastic_before_J, const WorkAudit& work,
                  const StepWork& w) {
  const double dt = out.last_step_s, half = 0.5 * dt;
  double energy = *out.elastic_J - elastic_before_J + work.cloth;
  for (int i = 0; i < m.freeCount(); ++i) {
    if (m.held[i]) continue;
    Vec3 change = half * (in.a[i] + out.a[i]) + (w.velocity[i] - w.predictor[i]);
    if (!w.pulled_after.empty()) change += half * w.pulled_after[i];
    if (!w.pulled_before.empty()) change -= half * w.pulled_before[i];
    if (!out.pressed.empty()) change += half * out.pressed[i];
    if (!in.pressed.empty()) change -= half * in.pressed[i];
    if (!m.sewing.empty()) change += m.inverse_mass[i] * w.sewn_closing[i];
    energy += m.mass_kg[i] *
              (0.5 * dot(change, in.v[i] + out.v[i]) - dt * dot(m.environment.gravity_m_per_s2, w.velocity[i]));
    if (!m.dead_force_N.empty()) energy -= dt * dot(m.dead_force_N[i], w.velocity[i]);
  }
  for (std::size_t k = 0; k < m.inner_mass.size(); ++k)
    energy += 0.25 * dt * m.inner_mass[k] * (in.inner_acceleration[k] + out.inner_acceleration[k]) *
              (in.inner_rate[k] + out.inner_rate[k]);
  return energy - (work.contact + work.drag + work.supports + work.limit + work.loads);
}

}  // namespace gambeson
