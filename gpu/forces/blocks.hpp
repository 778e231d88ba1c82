#pragma once
/// Blocks of lanes that share memory and exchange numbers, in the phases of gpu/device/lanes.hpp; on the host.

#include <memory>
#include <utility>

#include "gpu/device/reference.hpp"

namespace gambeson::gpu {

/// A block on the host: T lanes, one after the other in each phase.
template <int T>
struct HostBlock {
  static constexpr int kLanes = T;

  template <class Item>
  class PerLane {
   public:
    Item& operator[](int lane) { return items_[lane]; }
    const Item& operator[](int lane) const { return items_[lane]; }

   private:
    Item items_[T]{};
  };

  template <class F>
  void each(F&& f) const {
    for (int lane = 0; lane < T; ++lane) f(lane);
  }
  void sync() const {}
  /// Each lane gets what the lane has whose number differs in this bit, 1 to 16.
  template <class Item>
  void exchange(PerLane<Item>& items, int bit) const {
    for (int lane = 0; lane < T; ++lane)
      if (!(lane & bit)) std::swap(items[lane], items[lane | bit]);
  }
};

/// Runs kernel(block, shared memory, index) for n blocks of Kernel::kLanes lanes, of which at least Kernel::kResident
/// shall fit on a processor. Specialised beside each device.
template <class Device>
struct Blocks;

template <int W>
struct Blocks<ReferenceOf<W>> {
  template <class Kernel>
  static void run(typename ReferenceOf<W>::Queue&, int n, const Kernel& kernel) {
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < n; ++i) {
      const auto shared = std::make_unique<typename Kernel::Shared>();
      kernel(HostBlock<Kernel::kLanes>{}, *shared, i);
    }
  }
};

}  // namespace gambeson::gpu
