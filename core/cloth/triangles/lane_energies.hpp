#pragma once
/// Energies that kernels write by lanes, summed in their order.

#include "core/cloth/block_law.hpp"

namespace gambeson {

/// Of one block of elements after the other.
class LaneEnergies {
 public:
  /// `sum`: null where energy is not asked.
  LaneEnergies(ClothWork& work, ClothEnergy* sum) : work_(work), sum_(sum) {}

  /// Where the kernel writes what the block of so many lanes stores; `law` is told where it writes what is lost.
  double* start(int lanes, BlockLaw& law) {
    if (!sum_) return nullptr;
    const auto size = static_cast<std::size_t>(lanes);
    work_.lane_energy.assign(size, 0.0);
    if (law.remembers()) work_.lane_lost.assign(size, 0.0), law.lost = work_.lane_lost.data();
    return work_.lane_energy.data();
  }
  void add(const BlockLaw& law) {
    if (!sum_) return;
    for (const double e : work_.lane_energy) sum_->stored += e;
    if (law.lost)
      for (const double e : work_.lane_lost) sum_->lost += e;
  }

 private:
  ClothWork& work_;
  ClothEnergy* sum_;
};

}  // namespace gambeson
