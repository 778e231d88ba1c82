/// Detail of step_on_device.hpp: what a build without CUDA has in its place.
#include "core/error.hpp"
#include "gpu/step/step_on_device.hpp"

namespace gambeson::gpu {

std::unique_ptr<StepOnDevice> stepOnCuda(const Model&, const State&, const StageWork&) {
  throw RunError("CUDA: this program was built without it; configure with -DGAMBESON_CUDA=ON");
}

}  // namespace gambeson::gpu
