/// Detail of near_search.hpp and skin_bender.hpp: what a build without CUDA has in its place.
#include "core/error.hpp"
#include "gpu/near/near_search.hpp"
#include "gpu/near/skin_bender.hpp"

namespace gambeson::gpu {

namespace {
[[noreturn]] void refuse() {
  throw RunError("CUDA: this program was built without it; configure with -DGAMBESON_CUDA=ON");
}
}  // namespace

std::unique_ptr<NearSearch> nearOnCuda(const NearModel&, const NearStep&, const NearSizes&, int) { refuse(); }
std::unique_ptr<SkinBender> skinOnCuda(const Skin&, int) { refuse(); }

}  // namespace gambeson::gpu
