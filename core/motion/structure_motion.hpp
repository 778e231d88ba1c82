#pragma once
/// The motion of a structure: its states, whoever moves it.

#include "core/motion/model.hpp"
#include "core/statics/structure.hpp"

namespace gambeson {

/// The state of a structure with the unknowns y and their rates v and accelerations a (empty: 0), its supports where
/// they are prescribed at time t. `around_s`: over which their motion is differentiated, half of it on each side; 0:
/// 2e-6 (1 + |t|).
State structureState(const Structure& structure, double t, std::span<const double> y, std::span<const double> v,
                     std::span<const double> a, double around_s = 0);

/// Control points of a state, q = T p [m].
std::vector<Vec3> controlPoints(const Structure& structure, const State& state);

/// [J]
struct DynamicEnergy {
  double kinetic = 0, internal = 0, external = 0;  ///< external: minus the work of dead loads since rest
  double total() const { return kinetic + internal + external; }
};
DynamicEnergy energyOf(const Structure& structure, const State& state, bool lumped_mass);

/// The model of explicit steps of a structure that touches nothing.
std::unique_ptr<Model> untouchedModel(const Structure& structure, const StrainLimit& limit = {});

}  // namespace gambeson
