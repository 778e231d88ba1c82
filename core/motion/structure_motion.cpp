#include "core/motion/structure_motion.hpp"

#include <cmath>

#include "core/statics/statics.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {
namespace {

std::vector<double> componentsOf(const Structure& s, std::span<const double> y, std::span<const double> value) {
  const std::vector<double> none(y.empty() ? static_cast<std::size_t>(s.dofs.unknowns()) : 0, 0.0);
  return freeDisplacements(s, y.empty() ? std::span<const double>(none) : y, value);
}

std::vector<Vec3> pointsOf(const Structure& s, std::span<const double> u) {
  std::vector<Vec3> points(s.cloth->map().home.size());
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {u[3 * i], u[3 * i + 1], u[3 * i + 2]};
  return points;
}

}  // namespace

State structureState(const Structure& s, double t, std::span<const double> y, std::span<const double> v,
                     std::span<const double> a, double around) {
  const double half = around > 0 ? 0.5 * around : 1e-6 * (1 + std::abs(t));
  std::vector<double> rate = programValues(s, t + half, ProgramEnds::constant);
  const std::vector<double> before = programValues(s, t - half, ProgramEnds::constant);
  for (std::size_t k = 0; k < rate.size(); ++k) rate[k] = (rate[k] - before[k]) / (2 * half);
  State state;
  state.time_s = t;
  const std::vector<double> u = componentsOf(s, y, programValues(s, t, ProgramEnds::constant)),
                            du = componentsOf(s, v, rate),
                            ddu = componentsOf(s, a, std::vector<double>(rate.size(), 0.0));
  state.p = pointsOf(s, u);
  for (std::size_t i = 0; i < state.p.size(); ++i) state.p[i] += s.cloth->rest()[s.cloth->map().home[i]];
  state.v = pointsOf(s, du);
  state.a = pointsOf(s, ddu);
  const std::vector<double> none(y.empty() ? static_cast<std::size_t>(s.dofs.unknowns()) : 0, 0.0);
  state.inner =
      innerValues(s, y.empty() ? std::span<const double>(none) : y, programValues(s, t, ProgramEnds::constant));
  const auto innerOf = [&](const std::vector<double>& all) {
    const auto first = all.begin() + static_cast<long>(3 * state.p.size());
    return std::vector<double>(first, first + static_cast<long>(s.cloth->innerRates()));
  };
  state.inner_rate = innerOf(du);
  state.inner_acceleration = innerOf(ddu);
  state.y.assign(y.begin(), y.end());
  state.history.resize(s.cloth->historySize());
  s.cloth->startHistory(state.history);
  return state;
}

std::vector<Vec3> controlPoints(const Structure& s, const State& state) {
  std::vector<Vec3> q(s.cloth->rest().size());
  s.cloth->map().T.multiply<Vec3>(state.p, q);
  return q;
}

DynamicEnergy energyOf(const Structure& s, const State& state, bool lumped_mass) {
  DynamicEnergy energy;
  std::vector<Vec3> momentum(state.v.size());
  if (lumped_mass)
    for (std::size_t i = 0; i < momentum.size(); ++i) momentum[i] = s.lumped_kg[i] * state.v[i];
  else
    s.consistent_kg.multiply<Vec3>(state.v, momentum);
  for (std::size_t i = 0; i < momentum.size(); ++i) energy.kinetic += 0.5 * dot(state.v[i], momentum[i]);
  const std::vector<Vec3> q = controlPoints(s, state);
  for (std::size_t k = 0; k < state.inner_rate.size(); ++k)
    energy.kinetic += 0.5 * s.inner_mass[k] * state.inner_rate[k] * state.inner_rate[k];
  energy.internal = strainEnergy(s, {q, state.inner, state.history});
  for (const DeadLoad& load : s.dead)
    for (std::size_t i = 0; i < q.size(); ++i)
      energy.external -= s.programs[load.program](state.time_s) * dot(load.force_N[i], q[i] - s.cloth->rest()[i]);
  return energy;
}

std::unique_ptr<Model> untouchedModel(const Structure& s, const StrainLimit& limit) {
  ModelOptions o;
  o.structure = &s;
  o.strain_limit = limit;
  o.self_contact = false;
  return buildModel(s.cloth, o, {Vec3{}, 0}, {}, {});
}

}  // namespace gambeson
