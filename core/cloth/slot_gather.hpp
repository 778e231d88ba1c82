#pragma once
/// Sums the shares that elements write for their points, in a fixed order.

#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// Elements write their shares of the force to slots, each its own; a point's sum then takes them in the order in which
/// they were listed: no two threads write to one place, and the bits do not depend on their number.
class SlotGather {
 public:
  SlotGather() = default;
  explicit SlotGather(int points) : lists_(static_cast<std::size_t>(points)) {}

  /// A share of a point: x at `slot`, y and z at `stride` and twice that beyond it.
  void add(int point, long slot, int stride) { lists_[static_cast<std::size_t>(point)].push_back({slot, stride}); }
  /// To be called once, after all shares were listed.
  void close();
  /// f = - the sum of the shares.
  void negativeSum(const double* slots, std::span<Vec3> f) const;

 private:
  struct Share {
    long slot = 0;
    int stride = 1;
  };
  std::vector<std::vector<Share>> lists_;  ///< until it is closed
  std::vector<long> offsets_, slots_;
  std::vector<int> strides_;
};

}  // namespace gambeson
