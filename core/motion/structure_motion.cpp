#include <cmath>

#include "core/motion/implicit.hpp"
#include "core/motion/time_integration.hpp"
#include "core/statics/modal.hpp"
#include "core/statics/statics.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {

DynamicReport solveDynamic(const Structure& structure, const DynamicOptions& options, DynamicState& state,
                           const DynamicObserver& observe) {
  StructureSystem system(structure, ProgramEnds::constant);
  return integrate(system, options, state, observe);
}

std::vector<Mode> naturalModes(const Structure& structure, std::span<const double> y, double t, int count,
                               bool lumped_mass, std::span<const double> history) {
  refuseLimit(structure);
  StructureSystem system(structure, ProgramEnds::constant);
  if (!history.empty()) system.setHistory(history);
  return lowestModes(system, y, t, count, lumped_mass);
}

DynamicEnergy energyOf(const Structure& s, const DynamicState& state, bool lumped_mass) {
  DynamicEnergy energy;
  const double t = state.time_s;
  // Velocities of the free points; moving supports by the mean slope of their programs at t.
  const double dt = 1e-6 * (1 + std::abs(t));
  std::vector<double> rate = programValues(s, t + dt, ProgramEnds::constant);
  const std::vector<double> before = programValues(s, t - dt, ProgramEnds::constant);
  for (std::size_t k = 0; k < rate.size(); ++k) rate[k] = (rate[k] - before[k]) / (2 * dt);
  const std::vector<double> v = freeDisplacements(s, state.v, rate);
  const std::vector<Vec3> velocity(reinterpret_cast<const Vec3*>(v.data()),
                                   reinterpret_cast<const Vec3*>(v.data()) + v.size() / 3);
  std::vector<Vec3> momentum(velocity.size());
  if (lumped_mass)
    for (std::size_t i = 0; i < velocity.size(); ++i) momentum[i] = s.lumped_kg[i] * velocity[i];
  else
    s.consistent_kg.multiply<Vec3>(velocity, momentum);
  for (std::size_t i = 0; i < velocity.size(); ++i) energy.kinetic += 0.5 * dot(velocity[i], momentum[i]);
  energy.internal = strainEnergy(s, state.y, t, ProgramEnds::constant, state.history);
  const std::vector<Vec3> q = controlPoints(s, state.y, t);
  for (const DeadLoad& load : s.dead)
    for (std::size_t i = 0; i < q.size(); ++i)
      energy.external -= s.programs[load.program](t) * dot(load.force_N[i], q[i] - s.cloth->rest()[i]);
  return energy;
}

}  // namespace gambeson
