/// Detail of impact_search.hpp: what a build without CUDA has in its place.
#include "core/error.hpp"
#include "gpu/finding/impact_search.hpp"

namespace gambeson::gpu {

namespace {
[[noreturn]] void refuse() {
  throw RunError("CUDA: this program was built without it; configure with -DGAMBESON_CUDA=ON");
}
}  // namespace

bool cudaBuilt() { return false; }
std::string cudaDevice() { refuse(); }
std::unique_ptr<ImpactSearch> searchOnCuda(const Mesh&, std::span<const Vec3>, const SearchOptions&, const BothSizes&,
                                           int) {
  refuse();
}
std::vector<ImpactAnswer> answersOnCuda(std::span<const ImpactQuestion>) { refuse(); }

}  // namespace gambeson::gpu
