#pragma once
/// Blocks of lanes on CUDA: see blocks.hpp.

#include "gpu/device/cuda.cuh"
#include "gpu/forces/blocks.hpp"

namespace gambeson::gpu {

template <int T>
struct CudaBlock {
  static constexpr int kLanes = T;
  template <class Item>
  using PerLane = WarpLanes::PerLane<Item>;

  /// The lane is read anew in each phase, so that no address is kept in a register from one to the next.
  template <class F>
  __device__ void each(F&& f) const {
    int lane;
    asm volatile("mov.u32 %0, %%tid.x;" : "=r"(lane));
    f(lane);
  }
  __device__ void sync() const { __syncthreads(); }
  template <class Item>
  __device__ void exchange(PerLane<Item>& items, int bit) const {
    static_assert(sizeof(Item) % sizeof(double) == 0);
    double* at = reinterpret_cast<double*>(&items[0]);
#pragma unroll
    for (int k = 0; k < static_cast<int>(sizeof(Item) / sizeof(double)); ++k) at[k] = __shfl_xor_sync(~0u, at[k], bit);
  }
};

namespace kernel {

template <class Kernel>
__global__ void __launch_bounds__(Kernel::kLanes, Kernel::kResident) forBlocks(Kernel kernel) {
  extern __shared__ __align__(32) unsigned char block_shared[];
  kernel(CudaBlock<Kernel::kLanes>{}, *reinterpret_cast<typename Kernel::Shared*>(block_shared),
         static_cast<int>(blockIdx.x));
}

}  // namespace kernel

template <int G>
struct Blocks<CudaOf<G>> {
  template <class Kernel>
  static void run(typename CudaOf<G>::Queue& queue, int n, const Kernel& work) {
    static const bool roomy = [] {
      check(cudaFuncSetAttribute(kernel::forBlocks<Kernel>, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                 static_cast<int>(sizeof(typename Kernel::Shared))),
            "shared memory for a kernel");
      return true;
    }();
    static_cast<void>(roomy);
    if (n > 0) kernel::forBlocks<<<n, Kernel::kLanes, sizeof(typename Kernel::Shared), queue.stream()>>>(work);
    check(cudaGetLastError(), "a kernel over blocks");
  }
};

}  // namespace gambeson::gpu
