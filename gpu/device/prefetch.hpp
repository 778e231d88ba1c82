#pragma once
/// Asks for memory that will be read soon.

#include "core/math/vec.hpp"

namespace gambeson::gpu {

/// The 32 bytes around an address of the device, towards the processor. Nothing on the host.
GAMBESON_HD inline void prefetch(const void* at) {
#ifdef __CUDA_ARCH__
  asm volatile("prefetch.global.L1 [%0];" ::"l"(at));
#else
  static_cast<void>(at);
#endif
}

}  // namespace gambeson::gpu
