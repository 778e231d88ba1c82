#pragma once
/// Sweeps over all islands of a solve whose number only the device knows; on the host.

#include <memory>

#include "gpu/device/reference.hpp"
#include "gpu/solve/island_sweeps.hpp"

namespace gambeson::gpu {

/// How many islands there are, and how far sweeps go, stands on the device.
struct IslandRun {
  SolveData data;
  const SweepLimits* limits;
  const int* count;
  // Of those that have several chunks.
  const LargeIsland* large;
  const int* large_count;
  int* arrived;  ///< of the barriers of their teams, 0 before
};

/// Sweeps over small islands, and over large ones. Specialised beside each device.
template <class Device>
struct RunIslands;

template <int W>
struct RunIslands<ReferenceOf<W>> {
  using Queue = typename ReferenceOf<W>::Queue;

  static void runSmall(Queue&, const IslandRun& islands) {
    each(*islands.count, islands, [&](const Sweeps& sweeps, int i) {
      if (!isLarge(islands.data.islands[i])) sweeps.runAlone(Group{}, i);
    });
  }
  static void runLarge(Queue&, const IslandRun& islands) {
    each(*islands.large_count, islands, [&](const Sweeps& sweeps, int l) {
      sweeps.runTeam(Group{}, {islands.large[l].island, 0, 1, nullptr});
    });
  }

 private:
  using Group = HostQuads<8>;
  using Sweeps = IslandSweeps<Group>;

  template <class Visit>
  static void each(int count, const IslandRun& islands, const Visit& visit) {
    constexpr int kRoom = 2048;  // so that large ones take the other way
#pragma omp parallel for schedule(dynamic)
    for (int i = 0; i < count; ++i) {
      typename Sweeps::Shared shared;
      std::vector<Vec3> room(kRoom);
      visit(Sweeps(islands.data, *islands.limits, shared, room.data(), kRoom), i);
    }
  }
};

}  // namespace gambeson::gpu
