#pragma once
/// A line of straight pieces over time with rounded corners.

#include <cmath>
#include <vector>

#include "human/motion/smooth_step.hpp"

namespace gambeson {

/// Straight pieces through (t, x), level before the first and after the last, each corner rounded over `round_s` to
/// both sides: its slope passes from one to the other as a smootherStep. It is the line averaged with a positive
/// kernel, so it is C³, at rest `round_s` beyond its ends and within the range of x. Times ascend.
class RoundedLine {
 public:
  RoundedLine() = default;
  RoundedLine(std::vector<double> t, std::vector<double> x, double round_s)
      : t_(std::move(t)), x_(std::move(x)), round_s_(round_s) {}
  double at(double t) const {
    double x = x_.front(), slope = 0;
    for (std::size_t k = 0; k < t_.size(); ++k) {
      const double next = k + 1 < t_.size() ? (x_[k + 1] - x_[k]) / (t_[k + 1] - t_[k]) : 0;
      x += (next - slope) * ramp(t - t_[k]);
      slope = next;
    }
    return x;
  }

 private:
  /// The integral of a slope that goes from 0 to 1 about u = 0.
  double ramp(double u) const {
    if (u <= -round_s_) return 0;
    if (u >= round_s_) return u;
    return 2 * round_s_ * smootherArea(0.5 * (u / round_s_ + 1));
  }
  std::vector<double> t_, x_;
  double round_s_ = 0;
};

}  // namespace gambeson
