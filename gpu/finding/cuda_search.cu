/// Detail of impact_search.hpp: on a device of CUDA.
#include "gpu/device/cuda.cuh"
#include "gpu/finding/answers.hpp"
#include "gpu/finding/impact_finder.hpp"

namespace gambeson::gpu {

bool cudaBuilt() { return true; }

std::string cudaDevice() {
  int device = 0;
  cudaDeviceProp properties{};
  check(cudaGetDevice(&device), "finding a device");
  check(cudaGetDeviceProperties(&properties, device), "finding a device");
  return properties.name;
}

std::unique_ptr<ImpactSearch> searchOnCuda(const Mesh& mesh, std::span<const Vec3> positions,
                                           const SearchOptions& options, const BothSizes& room, int groups_per_block) {
  if (groups_per_block == 1 && options.broad == Broad::lbvh)
    return std::make_unique<ImpactFinder<CudaOf<1>>>(mesh, positions, options, room);
  return impactFinder<Cuda>(mesh, positions, options, room);
}

std::vector<ImpactAnswer> answersOnCuda(std::span<const ImpactQuestion> questions) { return answers<Cuda>(questions); }

}  // namespace gambeson::gpu
