#pragma once
/// The strides of a motion that goes on foot.

#include <string>
#include <vector>

namespace gambeson {

/// Strides of a walk or a climb, those that count: right foot strikes at start, start + time, ...
struct Strides {
  double start_s = 0, time_s = 0;
  int count = 0;
  double rest_s = 0;    ///< after the last whole stride, where paces are odd
  double foot_off = 0;  ///< phase of a foot's own stride at which it leaves the ground
  /// A thousand times spread evenly over the first stride.
  std::vector<double> thousandths() const;
  double end_s() const { return start_s + count * time_s + rest_s; }
  /// Of the side's own stride, [0, 1), 0 at its foot strike; the left foot strikes half a stride after the right.
  double phase(double t_s, const std::string& side) const;
};

}  // namespace gambeson
