// Stands in the place of cuda_sweeps.cu where the program is built without CUDA.
#include "core/error.hpp"
#include "gpu/solve/contact_sweeps.hpp"

namespace gambeson::gpu {

std::unique_ptr<ContactSweeps> sweepsOnCuda(const CudaSweepOptions&) {
  throw RunError("this program was built without CUDA (-DGAMBESON_CUDA=ON)");
}

}  // namespace gambeson::gpu
