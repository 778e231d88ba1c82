#include "core/motion/implicit_velocities.hpp"

#include <fmt/format.h>

namespace gambeson {

void ImplicitVelocities::bend(const Model& m, const State& in, double dt, FreeMotion& free, State& out,
                              double& inner_lost_J, StepWork& w) {
  const int n = m.freeCount();
  const double h = dt / options_.substeps;
  for (int k = 0; k < options_.substeps; ++k) {
    internalForce(m, at_, in.history, k * h, {}, force_, w, nullptr, {false, true, false});
    leadInnerForce(m, in.time_s + dt, w, force_);
    change_.resize(n);
    for (int i = 0; i < n; ++i) {
      free.elastic[i] += h * force_[i];
      change_[i] = m.held[i] ? Vec3{} : (h / m.mass_kg[i]) * force_[i];
    }
    if (m.supports) m.supports->hold(change_);
    for (int i = 0; i < n; ++i) at_.v[i] += change_[i];
    const double t = in.time_s + dt * k / options_.substeps;
    if (m.supports) m.supports->drive(t, t + h, at_.v);
    for (int i = 0; i < n; ++i) at_.p[i] += h * at_.v[i];
    inner_lost_J += moveInnerRates(m, h, out.inner_rate, w);
    m.cloth->advance(at_.inner, out.inner_rate, h, out.inner);
    at_.inner = out.inner;
  }
}

bool ImplicitVelocities::move(const Model& m, const Stage& stage, const State& in, double dt, FreeMotion& free,
                              State& out, StepReport& report, StepWork& w) {
  const int n = m.freeCount();
  const bool explicit_bending = options_.substeps > 0;
  const AnchorFrames after{w.stage.end.anchors, w.stage.end.vertices};
  const double end_s = in.time_s + dt;
  const Vec3 air = stage.air(end_s);
  free.elastic.assign(n, Vec3{});
  out.inner = in.inner;
  out.inner_rate = in.inner_rate;
  at_.time_s = in.time_s;
  at_.p = in.p;
  at_.v = in.v;
  at_.inner = in.inner;
  at_.history = in.history;
  at_.anchors = in.anchors;
  // All that is implicit, at the start.
  const ForceTerms terms{true, !explicit_bending, true};
  internalForce(m, at_, in.history, 0, {}, force_, w, nullptr, terms);
  if (!explicit_bending) leadInnerForce(m, end_s, w, force_);
  inner_force_ = w.inner_force;
  addStitchForces(m.stitches, m.surface.WT, in.p, force_);
  springForces(m, at_, after, w.spring_force);
  free.spring.resize(m.springs.size());
  const SparseRows& WT = m.surface.WT;
  for (std::size_t c = 0; c < m.springs.size(); ++c)
    for (int k = WT.offsets[m.springs[c].sample]; k < WT.offsets[m.springs[c].sample + 1]; ++k)
      force_[WT.columns[k]] += WT.values[k] * w.spring_force[c];
  free.spring = w.spring_force;
  if (!system_.assemble(m, at_, after, terms, dt, w)) {
    report.failure = StepFailure::not_finite;
    report.why = "a stiffness is not finite";
    return false;
  }
  free.loads.assign(m.supports ? n : 0, Vec3{});
  if (m.supports) {
    loadsAt(m, end_s, w.q, w.load, w);
    for (int i = 0; i < n; ++i) free.loads[i] = dt * w.load[i];
  }
  stretched_ = force_;

  // What moves explicitly, or by itself.
  double inner_lost_J = 0;  // by the drag of the inner unknowns
  if (explicit_bending) {
    bend(m, in, dt, free, out, inner_lost_J, w);
  } else {
    for (int i = 0; i < n; ++i) at_.p[i] += dt * at_.v[i];
  }
  known_ = at_.v;
  if (m.supports) {
    m.supports->drive(in.time_s, end_s, known_);
    m.supports->place(end_s, at_.p);
  }
  free.way.resize(n);
  for (int i = 0; i < n; ++i) free.way[i] = at_.p[i] - in.p[i];

  // The rest. Blocks behind the points are rates of inner unknowns, three in each.
  const int blocks = system_.rows();
  const bool inner_too = blocks > n && !explicit_bending;
  const auto innerAt = [&](std::size_t k) { return std::pair(n + k / 3, static_cast<int>(k % 3)); };
  b_.assign(blocks, Vec3{});
  product_.resize(blocks);
  whole_way_ = free.way;
  whole_way_.resize(blocks);
  for (std::size_t k = 0; inner_too && k < in.inner_rate.size(); ++k)
    whole_way_[innerAt(k).first][innerAt(k).second] = dt * in.inner_rate[k];
  system_.stiffness(whole_way_, product_);
  for (std::size_t k = 0; inner_too && k < in.inner_rate.size(); ++k) {
    const auto [block, d] = innerAt(k);
    const double drag = m.inner_drag_per_s * m.inner_mass[k] * in.inner_rate[k];
    b_[block][d] = dt * (inner_force_[k] - drag) - product_[block][d];
  }
  for (int i = 0; i < n; ++i) {
    Vec3 lasts = m.mass_kg[i] * m.environment.gravity_m_per_s2;
    if (!m.dead_force_N.empty()) lasts += m.dead_force_N[i];
    free.elastic[i] += dt * stretched_[i] - product_[i];
    b_[i] = dt * (stretched_[i] + lasts - m.drag_kg_per_s[i] * (known_[i] - air)) - product_[i] +
            m.mass_kg[i] * (at_.v[i] - known_[i]);
    if (m.supports) b_[i] += free.loads[i];
  }
  damped_.resize(blocks);
  whole_way_.assign(known_.begin(), known_.end());
  whole_way_.resize(blocks);
  const bool damps = system_.damping(whole_way_, damped_);
  for (int i = 0; damps && i < n; ++i) b_[i] -= dt * damped_[i];
  out.free_change.assign(blocks, Vec3{});
  if (in.free_change.size() == out.free_change.size()) out.free_change = in.free_change;
  const CgReport solved = system_.solve(b_, options_.tolerance, out.free_change);
  free.solve = {solved.iterations, solved.residual};
  report.solve = free.solve;
  if (!solved.converged) {
    report.failure = StepFailure::unsolved;
    report.why = solved.positive
                     ? fmt::format("the velocities are not found: after {} iterations {:.1e} of the impulses is left",
                                   solved.iterations, solved.residual)
                     : "the stiffness is not positive, so that the velocities cannot be solved for";
    return false;
  }

  const std::vector<Vec3>& change = out.free_change;
  if (!explicit_bending) {
    w.inner_force = inner_force_;
    if (!inner_too) {
      inner_lost_J = moveInnerRates(m, dt, out.inner_rate, w);
    } else {
      for (std::size_t k = 0; k < out.inner_rate.size(); ++k) {
        double& rate = out.inner_rate[k];
        rate += change[innerAt(k).first][innerAt(k).second];
        inner_lost_J += dt * m.inner_drag_per_s * m.inner_mass[k] * rate * rate;
      }
    }
    m.cloth->advance(in.inner, out.inner_rate, dt, out.inner);
  }
  free.velocity.resize(n);
  free.drag.resize(n);
  free.missed.assign(n, Vec3{});
  free.drag_work_J = -inner_lost_J;
  free.drag_lost_J = inner_lost_J;
  system_.multiply(change, product_);
  if (damps) {
    free.damping.resize(n);
    for (int i = 0; i < n; ++i) free.damping[i] = -dt * damped_[i];
    system_.damping(change, damped_);
    for (int i = 0; i < n; ++i) {
      free.damping[i] -= dt * damped_[i];
      free.elastic[i] += dt * damped_[i];  // the product below has it
    }
  }
  for (int i = 0; i < n; ++i) {
    const double d = m.drag_kg_per_s[i];
    free.velocity[i] = known_[i] + change[i];
    free.way[i] += dt * change[i];
    free.elastic[i] -= product_[i] - system_.own(i).x * change[i];
    free.drag[i] = (-dt * d) * (free.velocity[i] - air);
    if (!takesHold(m, i)) free.missed[i] = product_[i] - b_[i];
    if (m.held[i] && !m.supports) continue;
    if (damps) free.damping_lost_J -= dot(free.damping[i], free.velocity[i]);
    free.drag_work_J += dot(free.drag[i], free.velocity[i]);
    free.drag_lost_J -= dot(free.drag[i], free.velocity[i] - air);
  }
  for (std::size_t c = 0; c < free.spring.size(); ++c) {
    const Vec3 normal = after.normal(m.springs[c]), d = sampleAt(WT, m.springs[c].sample, free.way);
    free.spring[c] = dt * (free.spring[c] - m.springs[c].stiffness_N_per_m * (d - dot(d, normal) * normal));
  }
  return true;
}

}  // namespace gambeson
