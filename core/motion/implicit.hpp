#pragma once
/// Newmark's method and the generalised-alpha method.

#include <functional>
#include <string>

#include "core/motion/integrator.hpp"
#include "core/statics/structure_system.hpp"

namespace gambeson {

enum class ImplicitScheme { newmark, generalised_alpha };

struct ImplicitOptions {
  ImplicitScheme scheme = ImplicitScheme::generalised_alpha;
  double beta = 0.25, gamma = 0.5;  ///< Newmark
  double spectral_radius = 0.8;     ///< generalised-alpha, of infinite frequency, in [0, 1] (Chung and Hulbert 1993)
  double step_s = 0;                ///< halved where Newton fails, then restored
  int iterations = 20;
  double tolerance = 1e-8;
  bool lumped_mass = false;
};

/// What an implicit scheme moves: the unknowns of a system.
struct SystemState {
  double time_s = 0;
  std::vector<double> y, v, a;       ///< empty: 0
  std::vector<double> history = {};  ///< committed; empty: of new cloth, or the laws remember nothing
  double lost_J = 0;                 ///< by the laws since the start
};

struct ImplicitReport {
  bool reached = false;
  std::string why;
  long steps = 0, factorisations = 0, iterations = 0;  ///< iterations of Newton
};

/// Called after every accepted step; returns false to stop early.
using SystemObserver = std::function<bool(const SystemState&)>;
/// Starts from `state` (its a is set from equilibrium), ends exactly at end_s, leaves the last accepted state in it.
/// Throws InputError.
ImplicitReport integrate(System& system, const ImplicitOptions& options, double end_s, SystemState& state,
                         const SystemObserver& observe);

/// The same of a structure.
class ImplicitSteps : public Integrator {
 public:
  ImplicitSteps(const Structure& structure, const ImplicitOptions& options);
  void advance(double until_s, State& state, const StepObserver& observe) override;
  /// Of all that it has advanced.
  const ImplicitReport& report() const { return report_; }

 private:
  const Structure& structure_;
  ImplicitOptions options_;
  StructureSystem system_;
  ImplicitReport report_;
};

}  // namespace gambeson
