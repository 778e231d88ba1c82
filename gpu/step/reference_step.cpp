/// Detail of step_on_device.hpp: on the host.
#include "gpu/device/reference.hpp"
#include "gpu/step/device_step.hpp"

namespace gambeson::gpu {

std::unique_ptr<StepOnDevice> stepOnReference(const Model& model, const State& start, const StageWork& stage,
                                              double room) {
  return std::make_unique<DeviceStep<Reference>>(model, start, stage, room);
}

}  // namespace gambeson::gpu
