/// Detail of impact_step.hpp: on a device of CUDA.
#include "gpu/device/cuda.cuh"
#include "gpu/step/impact_step_on.hpp"

namespace gambeson::gpu {

std::unique_ptr<ImpactStep> impactStepOnCuda(const Model& model, std::span<const Vec3> start, const ImpactSizes& room,
                                             int groups_per_block) {
  if (groups_per_block == 1) return std::make_unique<ImpactStepOn<CudaOf<1>>>(model, start, room);
  return std::make_unique<ImpactStepOn<Cuda>>(model, start, room);
}

}  // namespace gambeson::gpu
