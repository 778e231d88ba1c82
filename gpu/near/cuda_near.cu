/// Detail of near_search.hpp and skin_bender.hpp: on a device of CUDA.
#include "gpu/device/cuda.cuh"
#include "gpu/near/near_finder.hpp"
#include "gpu/near/skin_on.hpp"

namespace gambeson::gpu {

std::unique_ptr<NearSearch> nearOnCuda(const NearModel& model, const NearStep& start, const NearSizes& room,
                                       int groups_per_block) {
  if (groups_per_block == 1) return std::make_unique<NearFinder<CudaOf<1>>>(model, start, room);
  return std::make_unique<NearFinder<Cuda>>(model, start, room);
}

std::unique_ptr<SkinBender> skinOnCuda(const Skin& skin, int most_times) {
  return std::make_unique<SkinOn<Cuda>>(skin, most_times);
}

}  // namespace gambeson::gpu
