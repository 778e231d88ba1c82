/// Detail of step_on_device.hpp: on a device of CUDA.
#include "gpu/device/cuda.cuh"
#include "gpu/forces/blocks.cuh"
#include "gpu/solve/run_islands.cuh"
#include "gpu/step/device_step.hpp"

namespace gambeson::gpu {

std::unique_ptr<StepOnDevice> stepOnCuda(const Model& model, const State& start, const StageWork& stage, double room) {
  return std::make_unique<DeviceStep<Cuda>>(model, start, stage, room);
}

}  // namespace gambeson::gpu
