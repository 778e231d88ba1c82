#pragma once
/// Sums the contributions that elements write for their points, in a fixed order.

#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// Elements write their contributions to the force to slots, each its own; a point's sum then takes them in the order
/// in which they were listed: no two threads write to one place, and the bits do not depend on their number.
class SlotGather {
 public:
  SlotGather() = default;
  explicit SlotGather(int points) : lists_(static_cast<std::size_t>(points)) {}

  /// A contribution to a point: x at `slot`, y and z at `stride` and twice that beyond it.
  void add(int point, long slot, int stride) { lists_[static_cast<std::size_t>(point)].push_back({slot, stride}); }
  /// To be called once, after all contributions were listed.
  void close();
  /// f = - the sum of the contributions.
  void negativeSum(const double* slots, std::span<Vec3> f) const;

 private:
  struct Contribution {
    long slot = 0;
    int stride = 1;
  };
  std::vector<std::vector<Contribution>> lists_;  ///< until it is closed
  std::vector<long> offsets_, slots_;
  std::vector<int> strides_;
};

}  // namespace gambeson
