/// Detail of impact_step.hpp: what a build without CUDA has in its place.
#include "core/error.hpp"
#include "gpu/step/impact_step.hpp"

namespace gambeson::gpu {

std::unique_ptr<ImpactStep> impactStepOnCuda(const Model&, std::span<const Vec3>, const ImpactSizes&, int) {
  throw RunError("CUDA: this program was built without it; configure with -DGAMBESON_CUDA=ON");
}

}  // namespace gambeson::gpu
