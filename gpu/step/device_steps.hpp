#pragma once
/// The whole step of worn cloth on a device, as an Integrator.

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/device_kind.hpp"
#include "core/motion/integrator.hpp"
#include "core/motion/motion_options.hpp"
#include "core/motion/step_control.hpp"

namespace gambeson::gpu {

/// What the steps of a device came to. The same on all devices.
struct DeviceCounts {
  long steps = 0;                       ///< accepted
  long by_cpu = 0;                      ///< of these: made by the CPU, from the same state
  long repeated = 0;                    ///< passes that were repeated with more room for their lists
  std::map<std::string, long> reasons;  ///< of the steps by the CPU, in words ("intersections")

  void add(const DeviceCounts& more);
};

/// Velocity Verlet as core has it. Rare work (intersections, impact zones, steps that are cut) is handed to the CPU.
class DeviceSteps : public Integrator {
 public:
  virtual DeviceCounts counts() const = 0;
};

/// What of a model or of the options of its motion is not carried, as a clause with the key of a case where there is
/// one; none: all.
std::optional<std::string> stepNotCarried(const Model& model, const MotionOptions& options, const StepControl& control);

/// Memory of the device that the steps of this model take, about [bytes]: a fit of what was measured on ten cases of
/// 4,000 to 21,000 samples (within 10 % on dressed bodies, up to 25 MB too much on small ones) and on a million. Lists
/// that run over take more.
std::size_t bytesOnDevice(const Model& model);

/// Both throw RunError for what is not carried; model, stage, frequency and work outlive what they give. The model must
/// not change meanwhile: where supports have let go, steps are made anew. `room`: the part of their usual room that
/// lists begin with, which changes no bit of a run.
std::unique_ptr<DeviceSteps> stepsOnReference(const Model& model, const gambeson::Stage& stage,
                                              const StepControl& control, Frequency& frequency, StepWork& work,
                                              double room = 1);
/// Throws DeviceError where the GPU cannot be used.
std::unique_ptr<DeviceSteps> stepsOnCuda(const Model& model, const gambeson::Stage& stage, const StepControl& control,
                                         Frequency& frequency, StepWork& work, double room = 1);

}  // namespace gambeson::gpu
