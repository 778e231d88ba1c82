#include "core/cloth/slot_gather.hpp"
#include "core/math/parallel.hpp"

namespace gambeson {

void SlotGather::close() {
  offsets_.push_back(0);
  for (const auto& list : lists_) {
    for (const Contribution& contribution : list) {
      slots_.push_back(contribution.slot);
      strides_.push_back(contribution.stride);
    }
    offsets_.push_back(static_cast<long>(slots_.size()));
  }
  lists_.clear();
  lists_.shrink_to_fit();
}

void SlotGather::negativeSum(const double* slots, std::span<Vec3> f) const {
  const int points = static_cast<int>(f.size());
  forAll(Each::sum, points, [&](int i) {
    Vec3 sum{};
    for (long k = offsets_[i]; k < offsets_[i + 1]; ++k) {
      const double* slot = slots + slots_[k];
      sum.x += slot[0];
      sum.y += slot[strides_[k]];
      sum.z += slot[2 * strides_[k]];
    }
    f[i] = -sum;
  });
}

}  // namespace gambeson
