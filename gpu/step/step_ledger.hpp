#pragma once
/// What steps on a device leave for the host: whole states, audits and what an observer makes of them, by a thread of
/// its own beside the device's next step.

#include "core/motion/integrator.hpp"
#include "gpu/step/in_order.hpp"
#include "gpu/step/step_on_device.hpp"

namespace gambeson::gpu {

/// What the control of steps reads of a state, and no arrays of points.
void copyControl(const State& from, State& to);

class StepLedger {
 public:
  StepLedger(const Model& model, const gambeson::Stage& stage, StepWork& work);

  /// From here on; `state` is the ledger's until `end` gives it back.
  void begin(State& state, const StepObserver& observe);
  void end(State& state);

  /// A step of `dt_s` that has been accepted. `after`: its control (copyControl).
  void add(StepDone&& done, double dt_s, const State& after, const StepReport& report, const Frequency& frequency);
  /// Waits until nothing is on its way, whether it failed or not.
  void settle();
  /// The state after all that was added. Waits; throws what an observer has thrown.
  State& state();
  /// A step from there that the CPU has made, into `after`, which becomes the state.
  void addByCpu(State& after, const StepReport& report, const Frequency& frequency);

 private:
  void take(StepDone& done, double dt, const State& control, StepReport report, const Frequency& frequency);
  void audit(double dt, const Vec3& air, StepReport& report);

  const Model& model_;
  const gambeson::Stage& stage_;
  StepWork& work_;
  State state_, next_;
  const StepObserver* observe_ = nullptr;
  InOrder thread_;
};

}  // namespace gambeson::gpu
