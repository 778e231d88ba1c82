/// Detail of forces.hpp: on a device of CUDA.
#include "gpu/forces/blocks.cuh"
#include "gpu/forces/shell_forces.hpp"

namespace gambeson::gpu {

std::unique_ptr<Forces> forcesOnCuda(const Cloth& cloth, const ForceOptions& options) {
  return forcesOn<Cuda>(cloth, options);
}

}  // namespace gambeson::gpu
