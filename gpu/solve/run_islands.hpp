#pragma once
/// Sweeps over all islands of a solve whose number only the device knows; on the host.

#include <memory>

#include "gpu/device/reference.hpp"
#include "gpu/solve/island_sweeps.hpp"

namespace gambeson::gpu {

/// Islands of one chunk each. `count`: how many there are; both it and the limits stand on the device.
struct IslandRun {
  SolveData data;
  const SweepLimits* limits;
  const int* count;
};

/// Specialised beside each device.
template <class Device>
struct RunIslands;

template <int W>
struct RunIslands<ReferenceOf<W>> {
  static void run(typename ReferenceOf<W>::Queue&, const IslandRun& islands) {
    using Group = HostQuads<8>;
    constexpr int kRoom = 2048;  // so that large ones take the other way
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < *islands.count; ++i) {
      typename IslandSweeps<Group>::Shared shared;
      std::vector<Vec3> room(kRoom);
      IslandSweeps<Group>(islands.data, *islands.limits, shared, room.data(), kRoom).run(Group{}, {i, 0, 1, nullptr});
    }
  }
};

}  // namespace gambeson::gpu
