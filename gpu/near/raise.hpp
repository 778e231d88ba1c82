#pragma once
/// The largest of what many lanes come with.

#include <bit>
#include <cstdint>

#include "gpu/device/atomics.hpp"

namespace gambeson::gpu {

/// Numbers of double precision, not NaN, in an order of integers; 0 comes before all of them.
GAMBESON_HD inline Count inOrder(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  return bits >> 63 != 0 ? ~bits : bits | std::uint64_t{1} << 63;
}
GAMBESON_HD inline double fromOrder(Count order) {
  const std::uint64_t bits = order;
  return std::bit_cast<double>(bits >> 63 != 0 ? bits & ~(std::uint64_t{1} << 63) : ~bits);
}

/// *at becomes no less than that. Most lanes come with less than what is there, and do not wait for each other.
GAMBESON_HD inline void raise(Count* at, Count value) {
#ifdef __CUDA_ARCH__
  if (__ldcg(at) < value) atomicMax(at, value);
#else
  const std::atomic_ref<Count> place(*at);
  Count seen = place.load(std::memory_order_relaxed);
  while (seen < value && !place.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
  }
#endif
}

}  // namespace gambeson::gpu
