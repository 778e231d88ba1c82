#pragma once
/// Detail of run.hpp: what moves a dynamic case, an integrator of structures.

#include <memory>

#include "cases/structure/build.hpp"
#include "cases/structure/case.hpp"
#include "core/motion/implicit.hpp"
#include "core/motion/free_steps.hpp"

namespace gambeson {

/// What moves a dynamic case.
class Mover {
 public:
  /// Case and model outlive it.
  Mover(const StructureCase& c, const StructureModel& model);

  /// Positions and velocities at time 0: noise, initial velocity, supports in their place.
  State start();

  void advance(double until_s, State& state, const StepObserver& observe) {
    integrator_->advance(until_s, state, observe);
  }
  ImplicitReport newton() const { return implicit_ ? implicit_->report() : ImplicitReport{}; }

 private:
  const StructureCase& case_;
  const StructureModel& model_;
  Frequency frequency_;
  StepWork work_;
  std::unique_ptr<Integrator> integrator_;
  const ImplicitSteps* implicit_ = nullptr;
};

}  // namespace gambeson
