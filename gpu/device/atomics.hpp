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

/// Puts `wanted` there where `expected` is, and says whether it was.
GAMBESON_HD inline bool swapIf(int* at, int expected, int wanted) {
#ifdef __CUDA_ARCH__
  return atomicCAS(at, expected, wanted) == expected;
#else
  return std::atomic_ref<int>(*at).compare_exchange_strong(expected, wanted, std::memory_order_relaxed);
#endif
}
/// What lanes of other groups may change meanwhile.
GAMBESON_HD inline int seen(const int& at) {
#ifdef __CUDA_ARCH__
  return __ldcg(&at);
#else
  return std::atomic_ref<int>(const_cast<int&>(at)).load(std::memory_order_relaxed);
#endif
}
template <class T>
GAMBESON_HD void put(T* at, T value) {
#ifdef __CUDA_ARCH__
  atomicExch(at, value);
#else
  std::atomic_ref<T>(*at).store(value, std::memory_order_relaxed);
#endif
}
GAMBESON_HD inline void fetchOr(std::uint32_t* at, std::uint32_t bits) {
#ifdef __CUDA_ARCH__
  atomicOr(at, bits);
#else
  std::atomic_ref<std::uint32_t>(*at).fetch_or(bits, std::memory_order_relaxed);
#endif
}
GAMBESON_HD inline void fetchMax(int* at, int other) {
#ifdef __CUDA_ARCH__
  atomicMax(at, other);
#else
  const std::atomic_ref<int> place(*at);
  for (int now = place.load(); other > now && !place.compare_exchange_weak(now, other);) {
  }
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
