/// Detail of step_on_device.hpp: what a build without CUDA has in its place.
#include "gpu/device/device_error.hpp"
#include "gpu/step/step_on_device.hpp"

namespace gambeson::gpu {

std::unique_ptr<StepOnDevice> stepOnCuda(const Model&, const State&, const StageWork&, double) {
  throw DeviceError(DeviceFault::not_built, "");
}

}  // namespace gambeson::gpu
