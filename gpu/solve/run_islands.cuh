#pragma once
/// Sweeps over all islands of a solve (run_islands.hpp) on CUDA: a block takes one after the other.

#include "gpu/device/cuda.cuh"
#include "gpu/device/quads.cuh"
#include "gpu/solve/run_islands.hpp"

namespace gambeson::gpu {
namespace kernel {

template <int Q>
__global__ void __launch_bounds__(Q* kQuad, 1) sweepAllIslands(IslandRun islands, int vectors) {
  using Sweeps = IslandSweeps<BlockQuads<Q>>;
  extern __shared__ double room[];
  __shared__ typename Sweeps::Shared shared;
  const int count = *islands.count;
  const SweepLimits limits = *islands.limits;
  for (int i = static_cast<int>(blockIdx.x); i < count; i += static_cast<int>(gridDim.x)) {
    Sweeps(islands.data, limits, shared, reinterpret_cast<Vec3*>(room), vectors)
        .run(BlockQuads<Q>{}, {i, 0, 1, nullptr});
    __syncthreads();
  }
}

}  // namespace kernel

template <int kGroups>
struct RunIslands<CudaOf<kGroups>> {
  static void run(typename CudaOf<kGroups>::Queue& queue, const IslandRun& islands) {
    constexpr int kQuads = 64, kVectors = 4096;
    constexpr std::size_t kShared = kVectors * sizeof(Vec3);
    static const int blocks = [] {
      int device = 0, processors = 0, of_processor = 0;
      check(cudaGetDevice(&device), "the device");
      check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device), "its processors");
      check(cudaFuncSetAttribute(kernel::sweepAllIslands<kQuads>, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                 static_cast<int>(kShared)),
            "room in shared memory");
      check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&of_processor, kernel::sweepAllIslands<kQuads>,
                                                          kQuads * kQuad, kShared),
            "the room for sweeps");
      return std::max(1, of_processor) * processors;
    }();
    kernel::sweepAllIslands<kQuads><<<blocks, kQuads * kQuad, kShared, queue.stream()>>>(islands, kVectors);
    check(cudaGetLastError(), "sweeps over islands");
  }
};

}  // namespace gambeson::gpu
