/// Detail of impact_search.hpp: on the host.
#include "gpu/device/reference.hpp"
#include "gpu/finding/answers.hpp"
#include "gpu/finding/impact_finder.hpp"

namespace gambeson::gpu {

std::unique_ptr<ImpactSearch> searchOnReference(const Mesh& mesh, std::span<const Vec3> positions,
                                                const SearchOptions& options, const BothSizes& room) {
  return impactFinder<Reference>(mesh, positions, options, room);
}

std::vector<ImpactAnswer> answersOnReference(std::span<const ImpactQuestion> questions) {
  return answers<Reference>(questions);
}

}  // namespace gambeson::gpu
