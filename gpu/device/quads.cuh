#pragma once
/// Groups of quads on CUDA (quads.hpp): a block.

#include "gpu/device/cuda_error.hpp"
#include "gpu/device/quads.hpp"

namespace gambeson::gpu {

template <int Q>
struct BlockQuads {
  static_assert(Q % 8 == 0 && Q <= kSumLanes);
  static constexpr int kQuads = Q, kLanes = Q * kQuad;

  template <class T>
  class PerLane {
   public:
    __device__ T& operator[](int) { return item_; }
    __device__ const T& operator[](int) const { return item_; }

   private:
    T item_{};
  };

  template <class F>
  __device__ void each(F&& f) const {
    f(static_cast<int>(threadIdx.x));
  }
  __device__ void sync() const { __syncthreads(); }
  __device__ void sumOfQuads(PerLane<Vec3>& v) const {
    Vec3& mine = v[0];
#pragma unroll
    for (int mask = 1; mask < kQuad; mask *= 2) {
      const Vec3 other{__shfl_xor_sync(~0u, mine.x, mask), __shfl_xor_sync(~0u, mine.y, mask),
                       __shfl_xor_sync(~0u, mine.z, mask)};
      mine += other;
    }
  }
  __device__ void gather(const PerLane<LaneTotals<Q>>& of, PartTotals& to) const {
    double largest = of[0].largest;
#pragma unroll
    for (int mask = kQuad; mask < 32; mask *= 2) largest = std::max(largest, __shfl_xor_sync(~0u, largest, mask));
    const int warp = static_cast<int>(threadIdx.x) / 32;
#pragma unroll
    for (int i = 0; i < kSumLanes / Q; ++i) {
      double part = of[0].part[i];
#pragma unroll
      for (int mask = kQuad; mask < 32; mask *= 2) part += __shfl_xor_sync(~0u, part, mask);
      if (threadIdx.x % 32 == 0) to.sum[warp + i * (Q / 8)] = part, to.largest[warp + i * (Q / 8)] = largest;
    }
  }
};

}  // namespace gambeson::gpu
