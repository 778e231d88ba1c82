#include "core/motion/motion_audit.hpp"

#include <algorithm>
#include <cmath>

#include "core/statics/statics.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {
namespace {

std::vector<Vec3> asPoints(const std::vector<double>& v) {
  std::vector<Vec3> points(v.size() / 3);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {v[3 * i], v[3 * i + 1], v[3 * i + 2]};
  return points;
}

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

}  // namespace

MotionAudit::MotionAudit(const Structure& structure, bool lumped_mass) : structure_(structure), lumped_(lumped_mass) {
  // A displacement that is an unknown, and no other's, is free: no support pushes there.
  const SparseRows& C = structure.dofs.C;
  std::vector<int> users(static_cast<std::size_t>(structure.dofs.unknowns()), 0);
  for (const int column : C.columns) ++users[static_cast<std::size_t>(column)];
  for (std::size_t r = 0; r + 1 < C.offsets.size(); ++r)
    free_.push_back(C.offsets[r + 1] - C.offsets[r] == 1 &&
                    users[static_cast<std::size_t>(C.columns[static_cast<std::size_t>(C.offsets[r])])] == 1);
}

MotionAudit::Moment MotionAudit::at(const DynamicState& state) const {
  const Structure& s = structure_;
  Moment m;
  const double t = m.time_s = state.time_s, dt = 1e-6 * (1 + std::abs(t));
  const std::vector<double> value = programValues(s, t, ProgramEnds::constant);
  std::vector<double> rate = programValues(s, t + dt, ProgramEnds::constant);
  const std::vector<double> before = programValues(s, t - dt, ProgramEnds::constant);
  for (std::size_t k = 0; k < rate.size(); ++k) rate[k] = (rate[k] - before[k]) / (2 * dt);
  m.u = asPoints(freeDisplacements(s, state.y, value));
  const std::vector<Vec3> v = asPoints(freeDisplacements(s, state.v, rate));
  const std::vector<Vec3> a = asPoints(freeDisplacements(s, state.a, std::vector<double>(rate.size(), 0.0)));
  const std::size_t n = m.u.size();
  std::vector<Vec3> Mv(n), Ma(n);
  if (lumped_) {
    for (std::size_t i = 0; i < n; ++i) Mv[i] = s.lumped_kg[i] * v[i], Ma[i] = s.lumped_kg[i] * a[i];
  } else {
    s.consistent_kg.multiply<Vec3>(v, Mv);
    s.consistent_kg.multiply<Vec3>(a, Ma);
  }
  const std::vector<Vec3> q = controlPoints(s, state.y, t);
  std::vector<Vec3> external(q.size());
  s.loads.add(q, value, external);
  m.load.resize(n);
  s.cloth->map().Tt.multiply<Vec3>(external, m.load);
  m.support.resize(n);
  s.cloth->map().Tt.multiply<Vec3>(reactions(s, state.y, t, ProgramEnds::constant, state.history), m.support);
  m.damping.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    m.damping[i] = s.rayleigh_mass_per_s * Mv[i] + s.drag_kg_per_m2s * s.area_m2[i] * v[i];
    m.support[i] += Ma[i] + m.damping[i];
    for (int d = 0; d < 3; ++d)
      if (free_[3 * i + static_cast<std::size_t>(d)]) m.support[i][d] = 0;
    m.energy_J += 0.5 * dot(v[i], Mv[i]);
  }
  m.energy_J += strainEnergy(s, state.y, t, ProgramEnds::constant, state.history) + state.lost_J;
  m.momentum_Ns = total(Mv);
  m.load_N = total(m.load);
  m.support_N = total(m.support);
  m.damping_N = total(m.damping);
  return m;
}

void MotionAudit::observe(const DynamicState& state) {
  Moment now = at(state);
  if (!last_) {
    start_J_ = now.energy_J;
    start_Ns_ = now.momentum_Ns;
    last_ = std::move(now);
    return;
  }
  const Moment& b = *last_;
  const double load = work(b.load, now.load, b.u, now.u), support = work(b.support, now.support, b.u, now.u),
               damping = work(b.damping, now.damping, b.u, now.u);
  balance_J_ += load + support - damping;
  works_J_ += std::abs(load) + std::abs(support) + std::abs(damping);
  gap_J_ = now.energy_J - start_J_ - balance_J_;
  largest_gap_J_ = std::max(largest_gap_J_, std::abs(gap_J_));
  const double half = 0.5 * (now.time_s - b.time_s);
  balance_Ns_ += half * (now.load_N + b.load_N + now.support_N + b.support_N - now.damping_N - b.damping_N);
  impulses_Ns_ += half * (norm(now.load_N) + norm(b.load_N) + norm(now.support_N) + norm(b.support_N) +
                          norm(now.damping_N) + norm(b.damping_N));
  gap_Ns_ = now.momentum_Ns - start_Ns_ - balance_Ns_;
  largest_gap_Ns_ = std::max(largest_gap_Ns_, norm(gap_Ns_));
  last_ = std::move(now);
}

}  // namespace gambeson
