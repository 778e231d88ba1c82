#pragma once
/// Sweeps over all islands of a solve (run_islands.hpp) on CUDA: a block takes one small island after the other; large
/// ones have teams of blocks.

#include "gpu/device/cuda.cuh"
#include "gpu/device/quads.cuh"
#include "gpu/solve/run_islands.hpp"

namespace gambeson::gpu {
namespace kernel {

/// The large island that a block takes in its turn, with others as a team, and as which of how many; without groups:
/// none. With fewer blocks than large islands a team is one block, which takes several.
__device__ inline SolveJob largeIsland(const IslandRun& islands, int turn) {
  const int large = *islands.large_count, blocks = static_cast<int>(gridDim.x), block = static_cast<int>(blockIdx.x),
            share = std::max(1, blocks / std::max(1, large)), teams = blocks / share, l = block / share + turn * teams;
  if (block / share >= teams || l >= large) return {0, 0, 0, nullptr};
  const LargeIsland of = islands.large[l];
  return {of.island, block % share, std::min(share, of.most_of_phase), islands.arrived + l};
}

template <int Q>
__global__ void __launch_bounds__(Q* kQuad, 1) sweepSmallIslands(IslandRun islands, int vectors) {
  using Sweeps = IslandSweeps<BlockQuads<Q>>;
  extern __shared__ double room[];
  __shared__ typename Sweeps::Shared shared;
  const int count = *islands.count;
  const SweepLimits limits = *islands.limits;
  const Sweeps sweeps(islands.data, limits, shared, reinterpret_cast<Vec3*>(room), vectors);
  for (int i = static_cast<int>(blockIdx.x); i < count; i += static_cast<int>(gridDim.x)) {
    if (isLarge(islands.data.islands[i])) continue;
    sweeps.runAlone(BlockQuads<Q>{}, i);
    __syncthreads();
  }
}

template <int Q>
__global__ void __launch_bounds__(Q* kQuad, 1) sweepLargeIslands(IslandRun islands, int vectors) {
  using Sweeps = IslandSweeps<BlockQuads<Q>>;
  extern __shared__ double room[];
  __shared__ typename Sweeps::Shared shared;
  const SweepLimits limits = *islands.limits;
  const Sweeps sweeps(islands.data, limits, shared, reinterpret_cast<Vec3*>(room), vectors);
  for (int turn = 0;; ++turn) {
    const SolveJob job = largeIsland(islands, turn);
    if (job.groups == 0) return;
    if (job.rank < job.groups) sweeps.runTeam(BlockQuads<Q>{}, job);
    __syncthreads();
  }
}

}  // namespace kernel

template <int kGroups>
struct RunIslands<CudaOf<kGroups>> {
  using Queue = typename CudaOf<kGroups>::Queue;

  static void runSmall(Queue& queue, const IslandRun& islands) {
    static const int blocks = blocksOf(kernel::sweepSmallIslands<kQuads>);
    kernel::sweepSmallIslands<kQuads><<<blocks, kQuads * kQuad, kShared, queue.stream()>>>(islands, kVectors);
    check(cudaGetLastError(), "sweeps over islands");
  }
  /// All blocks are on the device at once, since they wait for each other.
  static void runLarge(Queue& queue, const IslandRun& islands) {
    static const int blocks = blocksOf(kernel::sweepLargeIslands<kQuads>);
    cudaLaunchAttribute together{};
    together.id = cudaLaunchAttributeCooperative;
    together.val.cooperative = 1;
    cudaLaunchConfig_t launch{};
    launch.gridDim = static_cast<unsigned>(blocks);
    launch.blockDim = kQuads * kQuad;
    launch.dynamicSmemBytes = kShared;
    launch.stream = queue.stream();
    launch.attrs = &together;
    launch.numAttrs = 1;
    check(cudaLaunchKernelEx(&launch, kernel::sweepLargeIslands<kQuads>, islands, kVectors),
          "sweeps over large islands");
  }

 private:
  static constexpr int kQuads = 64, kVectors = 4096;
  static constexpr std::size_t kShared = kVectors * sizeof(Vec3);

  /// How many are on the device at once.
  static int blocksOf(void (*kernel)(IslandRun, int)) {
    int device = 0, processors = 0, of_processor = 0;
    check(cudaGetDevice(&device), "the device");
    check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device), "its processors");
    check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(kShared)),
          "room in shared memory");
    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&of_processor, kernel, kQuads * kQuad, kShared),
          "the room for sweeps");
    return std::max(1, of_processor) * processors;
  }
};

}  // namespace gambeson::gpu
