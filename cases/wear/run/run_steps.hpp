#pragma once
/// The steps of a run, on the device that was asked for.

#include <memory>
#include <optional>
#include <string>

#include "cases/runs/options.hpp"
#include "cases/wear/case/case.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/run/company.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "core/error.hpp"
#include "core/motion/integrator.hpp"
#include "gpu/device/fault_switch.hpp"
#include "gpu/step/device_steps.hpp"

namespace gambeson {

/// Throws InputError ("--device") where this program, driver or machine cannot have it. `folder`: name of the results
/// folder, for faults that tests provoke.
void requireDevice(DeviceKind device, const std::string& folder = "");

/// Says that there is a GPU and what uses it, where there is one.
void nameGpu();

/// Before anything runs: throws InputError where the device cannot be had, or where the case has a key that its steps
/// do not carry. Says where a GPU could make them and nobody asked for a device.
void checkDevice(const Case& c, const RunOptions& options);

/// Once the model is there: throws InputError for what only it shows, and where the GPU's memory is too small; says how
/// much of it is taken. In company it waits until the others leave so much.
Company::Share requireRoom(const Case& c, const RunOptions& options, const Model& model);

/// A GPU that was lost, or ran into a limit: nothing of this process can use it any more.
class DeviceLost : public RunError {
 public:
  using RunError::RunError;
};

/// The line of a shell that goes on with a run from its last checkpoint.
std::string resumeLine(const Case& c, const RunOptions& options);

/// Scenario, frequency and work outlive it.
class RunSteps {
 public:
  RunSteps(const Case& c, const RunOptions& options, const Scenario& scenario, Frequency& frequency, StepWork& work);

  /// Before the first advance, and where the model has changed.
  void make();
  /// As an Integrator has it. Throws DeviceError where the device fails.
  void advance(double until_s, State& state, const StepObserver& observe);

  DeviceFacts facts() const;

 private:
  const Case& case_;
  const Scenario& scenario_;
  Frequency& frequency_;
  StepWork& work_;
  DeviceKind kind_;
  std::optional<gpu::FaultSwitch> fault_;
  std::unique_ptr<Integrator> cpu_;
  std::unique_ptr<gpu::DeviceSteps> device_;
  gpu::DeviceCounts before_;  ///< of steps that were made anew since
  long accepted_ = 0;
};

}  // namespace gambeson
