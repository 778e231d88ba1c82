#pragma once
/// What lanes of different groups do to the same place. Nothing that is left may depend on who came first.

#include <atomic>
#include <cstdint>
#ifdef __CUDACC__
#include <cuda/atomic>
#endif

#include "core/math/vec.hpp"

namespace gambeson::gpu {

/// Of lists: large enough for what has no room, too.
using Count = unsigned long long;

/// Adds and gives what was there before.
template <class T>
GAMBESON_HD T fetchAdd(T* at, T by) {
#ifdef __CUDA_ARCH__
  return atomicAdd(at, by);
#else
  return std::atomic_ref<T>(*at).fetch_add(by, std::memory_order_relaxed);
#endif
}

/// Keeps the lesser, the larger of what is there and the other.
GAMBESON_HD inline void fetchMin(std::uint32_t* at, std::uint32_t other) {
#ifdef __CUDA_ARCH__
  atomicMin(at, other);
#else
  const std::atomic_ref<std::uint32_t> place(*at);
  for (std::uint32_t now = place.load(); other < now && !place.compare_exchange_weak(now, other);) {
  }
#endif
}
GAMBESON_HD inline void fetchMax(std::uint32_t* at, std::uint32_t other) {
#ifdef __CUDA_ARCH__
  atomicMax(at, other);
#else
  const std::atomic_ref<std::uint32_t> place(*at);
  for (std::uint32_t now = place.load(); other > now && !place.compare_exchange_weak(now, other);) {
  }
#endif
}

/// The second of two that come here is told so, and sees what the first wrote before it came. The flag is 0 before and
/// after.
GAMBESON_HD inline bool comesSecond(int* flag) {
#ifdef __CUDA_ARCH__
  const bool second = cuda::atomic_ref<int, cuda::thread_scope_device>(*flag).fetch_xor(1, cuda::memory_order_acq_rel);
#else
  const bool second = std::atomic_ref<int>(*flag).fetch_xor(1, std::memory_order_acq_rel);
#endif
  return second;
}

}  // namespace gambeson::gpu
