#pragma once
/// Time integration of a structure: Newmark, generalised-alpha and explicit central differences.

#include <functional>

#include "core/statics/structure.hpp"

namespace gambeson {

enum class TimeScheme { newmark, generalised_alpha, explicit_verlet };

struct DynamicOptions {
  TimeScheme scheme = TimeScheme::generalised_alpha;
  double beta = 0.25, gamma = 0.5;  ///< Newmark
  double spectral_radius = 0.8;     ///< generalised-alpha, of infinite frequency, in [0, 1] (Chung and Hulbert 1993)
  double step_s = 0;  ///< implicit: the step (halved where Newton fails, then restored). explicit: 0 takes `safety` of
                      ///< the stable one
  double safety = 0.9;  ///< of the stable step 2 / omega, explicit
  double end_s = 1;
  int iterations = 20;
  double tolerance = 1e-8;
  bool lumped_mass = false;  ///< implicit schemes; explicit ones always lump
};

/// With strain limits v holds the half step of their force, a does not (as State of core/motion/model.hpp).
struct DynamicState {
  double time_s = 0;
  std::vector<double> y, v, a;
  std::vector<double> history = {};  ///< committed; empty: of new cloth, or the laws remember nothing
  double lost_J = 0;                 ///< by the laws since the start
  std::vector<double> limit_J = {};  ///< multipliers of the strain limits in the last step; empty: none
};

struct DynamicReport {
  bool reached = false;
  std::string why;
  long steps = 0, factorisations = 0;
  long iterations = 0;                      ///< of Newton, implicit schemes
  long projections = 0, limits_missed = 0;  ///< of strain limits: in all, and steps that did not reach the tolerance
  double limit_residual = 0;                ///< the largest after a step
};

struct DynamicEnergy {
  double kinetic = 0, internal = 0, external = 0;  ///< external: minus the work of dead loads since rest
  double total() const { return kinetic + internal + external; }
};
DynamicEnergy energyOf(const Structure& structure, const DynamicState& state, bool lumped_mass);

/// Called after every accepted step; returns false to stop early.
using DynamicObserver = std::function<bool(const DynamicState&)>;
/// Starts from `state` (its a is set from equilibrium), ends exactly at end_s, leaves the last accepted state in it.
DynamicReport solveDynamic(const Structure& structure, const DynamicOptions& options, DynamicState& state,
                           const DynamicObserver& observe);

}  // namespace gambeson
