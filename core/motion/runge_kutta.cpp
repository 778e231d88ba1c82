#include "core/motion/runge_kutta.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/motion/cloth_damping.hpp"
#include "core/motion/forces.hpp"

namespace gambeson {
namespace {

/// Of the stages: where they stand in the step, in parts of it along the slopes of the one before, and their weights.
struct Stages {
  int count;
  std::array<double, 4> at, weight;
};
const Stages& stagesOf(RungeKuttaOrder order) {
  static const Stages euler{1, {0}, {1}}, midpoint{2, {0, 0.5}, {0, 1}},
      fourth{4, {0, 0.5, 0.5, 1}, {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6}};
  return order == RungeKuttaOrder::midpoint ? midpoint : order == RungeKuttaOrder::fourth ? fourth : euler;
}

}  // namespace

double longestStableStep(RungeKuttaOrder order, double omega, double damping) {
  if (order == RungeKuttaOrder::fourth) return 2 * std::sqrt(2.0) / omega;
  if (order == RungeKuttaOrder::symplectic) return 2 / omega;
  const double longest =
      order == RungeKuttaOrder::euler ? damping / (omega * omega) : std::cbrt(4 * damping / std::pow(omega, 4));
  return std::min(longest, 1 / omega);
}

RungeKutta::RungeKutta(RungeKuttaOrder order) : order_(order), slopes_(stagesOf(order).count) {}

/// at_ goes along the slopes of the stage before.
void RungeKutta::follow(const Model& m, const State& in, double dt, int k) {
  const double part = stagesOf(order_).at[k] * dt;
  const Slopes& before = slopes_[k - 1];
  at_.time_s = in.time_s + part;
  at_.p.resize(in.p.size());
  at_.v.resize(in.p.size());
  for (std::size_t i = 0; i < in.p.size(); ++i) {
    at_.p[i] = in.p[i] + part * before.velocity[i];
    at_.v[i] = in.v[i] + part * before.acceleration[i];
  }
  at_.inner.resize(in.inner.size());
  at_.inner_rate = in.inner_rate;
  m.cloth->advance(in.inner, before.inner_rate, part, at_.inner);
  for (std::size_t i = 0; i < at_.inner_rate.size(); ++i) at_.inner_rate[i] += part * before.inner_acceleration[i];
  at_.inner_acceleration.resize(at_.inner_rate.size());
  at_.anchors = in.anchors;
  if (m.supports) {
    m.supports->place(at_.time_s, at_.p);
    m.supports->placeInner(at_.time_s, at_.p, at_.inner);
  }
}

bool RungeKutta::move(const Model& m, const Stage& stage, const State& in, double dt, FreeMotion& free, State& out,
                      StepReport&, StepWork& w) {
  const Stages& stages = stagesOf(order_);
  const int n = m.freeCount();
  for (std::vector<Vec3>* sum : {&free.way, &free.velocity, &free.elastic, &free.drag}) sum->assign(n, Vec3{});
  free.loads.assign(m.supports ? n : 0, Vec3{});
  free.missed.clear();
  free.spring.assign(m.springs.size(), Vec3{});
  free.drag_work_J = free.drag_lost_J = 0;
  if (m.cloth->damps()) free.damping.assign(n, Vec3{});
  rate_.assign(in.inner_rate.size(), 0.0);
  out.inner_rate = in.inner_rate;
  for (int k = 0; k < stages.count; ++k) {
    const double share = stages.weight[k] * dt;
    const Vec3 air = stage.air(in.time_s + stages.at[k] * dt);
    // The stage's State: the first is the step's start, whose forces the step before has left.
    if (k > 0) {
      follow(m, in, dt, k);
      at_.history = in.history;
      const AnchorInstant now(m, stage, at_.time_s);
      accelerate(m, now.frames(), air, std::vector<Vec3>(at_.v), {}, {0, dt, stages.at[k] * dt}, nullptr, at_, w);
    } else {
      springForces(m, in, {w.stage.start.anchors, w.stage.start.vertices}, w.spring_force);
      if (m.supports) {
        w.q.resize(m.cloth->points());
        m.cloth->map().T.multiply<Vec3>(in.p, w.q);
        loadsAt(m, in.time_s, w.q, w.load, w);
      }
      if (m.cloth->damps()) {
        w.q.resize(m.cloth->points());
        m.cloth->map().T.multiply<Vec3>(in.p, w.q);
        w.damping = clothDamping(*m.cloth, w.q, in.v);
      }
    }
    const State& s = k > 0 ? at_ : in;
    slopes_[k] = {s.v, s.a, s.inner_rate, s.inner_acceleration};
    if (share == 0) continue;
    std::size_t slot = 0;
    for (int i = 0; i < n; ++i) {
      const Vec3 drag = -m.drag_kg_per_s[i] * (s.v[i] - air);
      Vec3 elastic = m.mass_kg[i] * (s.a[i] - m.environment.gravity_m_per_s2) - drag;
      if (!m.dead_force_N.empty()) elastic -= m.dead_force_N[i];
      if (takesHold(m, i)) elastic -= s.held_N[slot++];
      if (m.supports) {
        elastic -= w.load[i];
        free.loads[i] += share * w.load[i];
      }
      if (!free.damping.empty()) {
        elastic -= w.damping[i];
        free.damping[i] += share * w.damping[i];
        free.damping_lost_J -= share * dot(w.damping[i], s.v[i]);
      }
      free.elastic[i] += share * elastic;
      free.drag[i] += share * drag;
      if (!(m.held[i] && !m.supports)) {
        free.drag_work_J += share * dot(drag, s.v[i]);
        free.drag_lost_J -= share * dot(drag, s.v[i] - air);
      }
      free.way[i] += share * s.v[i];
      free.velocity[i] += share * s.a[i];
    }
    for (std::size_t c = 0; c < free.spring.size(); ++c) free.spring[c] += share * w.spring_force[c];
    for (std::size_t c = 0; c < rate_.size(); ++c) {
      rate_[c] += stages.weight[k] * s.inner_rate[c];
      out.inner_rate[c] += share * s.inner_acceleration[c];
      const double lost = share * m.inner_drag_per_s * m.inner_mass[c] * s.inner_rate[c] * s.inner_rate[c];
      free.drag_work_J -= lost;
      free.drag_lost_J += lost;
    }
  }
  for (int i = 0; i < n; ++i) free.velocity[i] += in.v[i];
  if (order_ == RungeKuttaOrder::symplectic) {
    for (int i = 0; i < n; ++i) free.way[i] = dt * free.velocity[i];
    rate_ = out.inner_rate;
  }
  out.inner.resize(in.inner.size());
  m.cloth->advance(in.inner, rate_, dt, out.inner);
  return true;
}

}  // namespace gambeson
