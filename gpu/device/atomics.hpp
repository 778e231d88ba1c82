#pragma once
/// What lanes of different groups do to the same place. Nothing that is left may depend on who came first.

#include <atomic>

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

/// The second of two that come here is told so, and sees (by `fresh`) what the first wrote before it came. The flag is
/// 0 before and after.
GAMBESON_HD inline bool comesSecond(int* flag) {
#ifdef __CUDA_ARCH__
  __threadfence();
  if (atomicAdd(flag, 1) == 0) return false;
  __threadfence();
#else
  if (std::atomic_ref<int>(*flag).fetch_add(1, std::memory_order_acq_rel) == 0) return false;
#endif
  *flag = 0;
  return true;
}

/// Read past the caches of this processor alone.
GAMBESON_HD inline float fresh(const float& x) {
#ifdef __CUDA_ARCH__
  return __ldcg(&x);
#else
  return x;
#endif
}

}  // namespace gambeson::gpu
