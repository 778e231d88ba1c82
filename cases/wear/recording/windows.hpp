#pragma once
/// The windows of a run. Steps end exactly with them, so whoever steps a case again along them gets the same bits.

#include <algorithm>
#include <cmath>

namespace gambeson {

/// Ends of the windows: multiples of the window's length, from the start to the end of the run.
class Windows {
 public:
  Windows(double start, double end, double length) : start_(start), end_(end), length_(length) {
    first_ = static_cast<long>(std::floor(start / length + 1e-9));
    count_ = static_cast<long>(std::ceil(end / length - 1e-9)) - first_;
  }
  long count() const { return count_; }
  double bound(long k) const {
    return k == 0 ? start_ : k == count_ ? end_ : static_cast<double>(first_ + k) * length_;
  }
  /// Whether the window that ends at bound(k) completes a multiple of `period`; the last always does.
  bool completes(long k, double period) const {
    return k == count_ || (first_ + k) % std::max(1L, std::lround(period / length_)) == 0;
  }

 private:
  double start_, end_, length_;
  long first_ = 0, count_ = 0;
};

}  // namespace gambeson
