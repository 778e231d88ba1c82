#pragma once
/// Groups of lanes: how kernels are written once for CUDA and for the host.
///
/// A kernel is a functor over the index of an item, or over a group of lanes and the group's index. Code for a group
/// goes in phases: what stands in `each` is done by every lane, what stands outside is the same for all of them, and a
/// number that a lane keeps from phase to phase is `PerLane`. On CUDA a group is a warp and a PerLane a register; on
/// the host a group of any width is a loop. What a kernel leaves may not depend on the width.

#include <bit>
#include <cstdint>

#include "core/math/vec.hpp"

namespace gambeson::gpu {

using LaneMask = std::uint32_t;

GAMBESON_HD inline int lanesIn(LaneMask mask) {
#ifdef __CUDA_ARCH__
  return __popc(mask);
#else
  return std::popcount(mask);
#endif
}
/// How many lanes of the mask come before this one.
GAMBESON_HD inline int lanesBefore(LaneMask mask, int lane) { return lanesIn(mask & ((LaneMask{1} << lane) - 1)); }

/// The first bit that is not set, of which there is one.
GAMBESON_HD inline int firstClear(LaneMask mask) {
#ifdef __CUDA_ARCH__
  return __ffs(static_cast<int>(~mask)) - 1;
#else
  return std::countr_one(mask);
#endif
}

/// A group on the host.
template <int W>
struct HostLanes {
  static_assert(W >= 1 && W <= 32);
  static constexpr int kLanes = W;

  template <class T>
  class PerLane {
   public:
    PerLane() = default;
    explicit PerLane(const T& all) {
      for (T& item : items_) item = all;
    }
    T& operator[](int lane) { return items_[lane]; }
    const T& operator[](int lane) const { return items_[lane]; }

   private:
    T items_[W];
  };

  template <class F>
  void each(F&& f) const {
    for (int lane = 0; lane < W; ++lane) f(lane);
  }
  LaneMask ballot(const PerLane<bool>& on) const {
    LaneMask mask = 0;
    for (int lane = 0; lane < W; ++lane) mask |= static_cast<LaneMask>(on[lane]) << lane;
    return mask;
  }
  /// The bits that any lane has.
  std::uint32_t orOf(const PerLane<std::uint32_t>& bits) const {
    std::uint32_t all = 0;
    for (int lane = 0; lane < W; ++lane) all |= bits[lane];
    return all;
  }
  /// What a lane has.
  template <class T>
  const T& of(const PerLane<T>& items, int lane) const {
    return items[lane];
  }
  /// f() by one lane; all get what it gives.
  template <class F>
  auto once(F&& f) const {
    return f();
  }
  /// What lanes wrote to the group's shared memory before is seen by all of them after.
  void sync() const {}
};

}  // namespace gambeson::gpu
