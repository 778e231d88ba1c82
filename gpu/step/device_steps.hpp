#pragma once
/// Velocity Verlet with its steps on a device: where and in which lengths steps are made is decided on the host, as on
/// the CPU; what a device does not do itself (cloth that is tangled, pinched or inside of a body, steps that must be
/// cut) the CPU does from the same state.

#include <array>
#include <memory>
#include <optional>
#include <string>

#include "core/motion/step_control.hpp"
#include "gpu/step/step_on_device.hpp"

namespace gambeson::gpu {

/// Steps so far.
struct DeviceCounts {
  long steps = 0;
  std::array<long, static_cast<std::size_t>(ByCpu::kReasons)> by_cpu{};  ///< of these, by why

  long byCpu() const;
};

/// An integrator that counts.
class DeviceIntegrator : public Integrator {
 public:
  virtual const DeviceCounts& counts() const = 0;
};

/// What of a model or its control a step on a device does not carry, in words; none: all.
std::optional<std::string> stepNotCarried(const Model& model, const StepControl& control);

/// All that is given outlives the integrator; a model that changes (supports let go) needs a new one. Throw RunError
/// for what is not carried, and `stepsOnCuda` where there is no device.
std::unique_ptr<DeviceIntegrator> stepsOnReference(const Model& model, const gambeson::Stage& stage,
                                                   const StepControl& control, Frequency& frequency, StepWork& work);
std::unique_ptr<DeviceIntegrator> stepsOnCuda(const Model& model, const gambeson::Stage& stage,
                                              const StepControl& control, Frequency& frequency, StepWork& work);

}  // namespace gambeson::gpu
