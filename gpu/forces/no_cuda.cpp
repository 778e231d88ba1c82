/// Detail of forces.hpp: what a build without CUDA has in its place.
#include "core/error.hpp"
#include "gpu/forces/forces.hpp"

namespace gambeson::gpu {

std::unique_ptr<Forces> forcesOnCuda(const Cloth&, const ForceOptions&) {
  throw RunError("CUDA: this program was built without it; configure with -DGAMBESON_CUDA=ON");
}

}  // namespace gambeson::gpu
