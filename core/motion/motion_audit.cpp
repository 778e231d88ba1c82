#include "core/motion/motion_audit.hpp"

#include <algorithm>
#include <cmath>

#include "core/motion/cloth_damping.hpp"
#include "core/statics/statics.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {
namespace {

Vec3 total(const std::vector<Vec3>& f) {
  Vec3 sum;
  for (const Vec3& x : f) sum += x;
  return sum;
}

/// ∑ (a + b)/2 . (to - from)
double work(const std::vector<Vec3>& a, const std::vector<Vec3>& b, const std::vector<Vec3>& from,
            const std::vector<Vec3>& to) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += 0.5 * dot(a[i] + b[i], to[i] - from[i]);
  return sum;
}

double work(const std::vector<double>& a, const std::vector<double>& b, const std::vector<double>& from,
            const std::vector<double>& to) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += 0.5 * (a[i] + b[i]) * (to[i] - from[i]);
  return sum;
}

}  // namespace

MotionAudit::MotionAudit(const Structure& structure, bool lumped_mass) : structure_(structure), lumped_(lumped_mass) {
  // A displacement that is an unknown, and no other's, is free: no support pushes there.
  const SparseRows& C = structure.dofs.C;
  std::vector<int> users(static_cast<std::size_t>(structure.dofs.unknowns()), 0);
  for (const int column : C.columns) ++users[static_cast<std::size_t>(column)];
  const std::size_t points = 3 * structure.cloth->map().home.size();
  for (std::size_t r = 0; r < points + structure.inner_mass.size(); ++r)
    (r < points ? free_ : inner_free_)
        .push_back(C.offsets[r + 1] - C.offsets[r] == 1 &&
                   users[static_cast<std::size_t>(C.columns[static_cast<std::size_t>(C.offsets[r])])] == 1);
}

MotionAudit::Moment MotionAudit::at(const State& state) const {
  const Structure& s = structure_;
  Moment m;
  const double t = m.time_s = state.time_s;
  const std::size_t n = state.p.size();
  m.u = state.p;
  for (std::size_t i = 0; i < n; ++i) m.u[i] -= s.cloth->rest()[s.cloth->map().home[i]];
  const std::vector<Vec3>&v = state.v, &a = state.a;
  std::vector<Vec3> Mv(n), Ma(n);
  if (lumped_) {
    for (std::size_t i = 0; i < n; ++i) Mv[i] = s.lumped_kg[i] * v[i], Ma[i] = s.lumped_kg[i] * a[i];
  } else {
    s.consistent_kg.multiply<Vec3>(v, Mv);
    s.consistent_kg.multiply<Vec3>(a, Ma);
  }
  const std::vector<Vec3> q = controlPoints(s, state);
  std::vector<Vec3> external(q.size());
  s.loads.add(q, programValues(s, t, ProgramEnds::constant), external);
  m.load.resize(n);
  s.cloth->map().Tt.multiply<Vec3>(external, m.load);
  m.support.resize(n);
  m.inner = state.inner;
  m.inner_load.resize(s.inner_mass.size());
  s.loads.addInner(programValues(s, t, ProgramEnds::constant), m.inner_load);
  std::vector<Vec3> force(q.size());
  m.inner_support.resize(s.inner_mass.size());
  ClothWork scratch;
  s.cloth->force({q, state.inner, state.history}, {force, m.inner_support, {}, nullptr}, scratch);
  for (std::size_t i = 0; i < q.size(); ++i) force[i] = -(force[i] + external[i]);
  s.cloth->map().Tt.multiply<Vec3>(force, m.support);
  const double per_mass = s.rayleigh_mass_per_s + s.innerDrag();
  m.inner_damping.resize(s.inner_mass.size());
  for (std::size_t k = 0; k < s.inner_mass.size(); ++k) {
    m.inner_damping[k] = per_mass * s.inner_mass[k] * state.inner_rate[k];
    m.inner_support[k] = inner_free_[k] ? 0
                                        : s.inner_mass[k] * state.inner_acceleration[k] + m.inner_damping[k] -
                                              m.inner_support[k] - m.inner_load[k];
    m.energy_J += 0.5 * s.inner_mass[k] * state.inner_rate[k] * state.inner_rate[k];
  }
  m.damping.resize(n);
  const std::vector<Vec3> own = clothDamping(*s.cloth, q, v);
  for (std::size_t i = 0; i < n; ++i) {
    m.damping[i] = s.rayleigh_mass_per_s * Mv[i] + s.drag_kg_per_m2s * s.area_m2[i] * v[i];
    if (!own.empty()) m.damping[i] -= own[i];
    m.support[i] += Ma[i] + m.damping[i];
    for (int d = 0; d < 3; ++d)
      if (free_[3 * i + static_cast<std::size_t>(d)]) m.support[i][d] = 0;
    m.energy_J += 0.5 * dot(v[i], Mv[i]);
  }
  m.energy_J += strainEnergy(s, {q, state.inner, state.history});
  m.momentum_Ns = total(Mv);
  m.load_N = total(m.load);
  m.support_N = total(m.support);
  m.damping_N = total(m.damping);
  return m;
}

void MotionAudit::closeEnergy(double energy_J) {
  gap_J_ = energy_J + lost_J_ - start_J_ - balance_J_;
  largest_gap_J_ = std::max(largest_gap_J_, std::abs(gap_J_));
}

void MotionAudit::observe(const State& state, double lost_J) {
  Moment now = at(state);
  lost_J_ += lost_J;
  if (!last_) {
    lost_J_ = 0;
    start_J_ = now.energy_J;
    start_Ns_ = now.momentum_Ns;
    last_ = std::move(now);
    return;
  }
  const Moment& b = *last_;
  const auto workOf = [&](const std::vector<Vec3> Moment::*points, const std::vector<double> Moment::*inner) {
    return work(b.*points, now.*points, b.u, now.u) + work(b.*inner, now.*inner, b.inner, now.inner);
  };
  const double load = workOf(&Moment::load, &Moment::inner_load),
               support = workOf(&Moment::support, &Moment::inner_support),
               damping = workOf(&Moment::damping, &Moment::inner_damping);
  balance_J_ += load + support - damping;
  works_J_ += std::abs(load) + std::abs(support) + std::abs(damping);
  closeEnergy(now.energy_J);
  const double half = 0.5 * (now.time_s - b.time_s);
  balance_Ns_ += half * (now.load_N + b.load_N + now.support_N + b.support_N - now.damping_N - b.damping_N);
  impulses_Ns_ += half * (norm(now.load_N) + norm(b.load_N) + norm(now.support_N) + norm(b.support_N) +
                          norm(now.damping_N) + norm(b.damping_N));
  gap_Ns_ = now.momentum_Ns - start_Ns_ - balance_Ns_;
  largest_gap_Ns_ = std::max(largest_gap_Ns_, norm(gap_Ns_));
  last_ = std::move(now);
}

void MotionAudit::observe(const State& before, const State& after, const StepReport& r) {
  const auto energy = [&](const State& s) {
    const DynamicEnergy e = energyOf(structure_, s, true);
    return e.kinetic + e.internal;
  };
  if (!start_of_steps_J_) start_J_ = *(start_of_steps_J_ = energy(before));
  const WorkAudit& w = r.work;
  balance_J_ += w.loads + w.supports + w.contact + w.limit + w.drag + w.integrator;
  integrator_J_ += w.integrator;
  works_J_ +=
      std::abs(w.loads) + std::abs(w.supports) + std::abs(w.contact) + std::abs(w.limit) + std::abs(w.drag) + w.cloth;
  lost_J_ += w.cloth;
  closeEnergy(energy(after));
  const MomentumAudit& m = r.momentum;
  impulses_Ns_ += norm(m.dead) + norm(m.supports) + norm(m.drag) + norm(m.pressing) + norm(m.obstacles);
  gap_Ns_ += m.change - (m.gravity + m.dead + m.drag + m.supports + m.pressing + m.missed - m.obstacles);
  largest_gap_Ns_ = std::max(largest_gap_Ns_, norm(gap_Ns_));
}

}  // namespace gambeson
