#pragma once
/// Periodic cubic spline through equally spaced values: C², the curve of a cyclic movement over its phase.

#include <vector>

namespace gambeson {

class PeriodicSpline {
 public:
  PeriodicSpline() = default;
  /// Value i stands at phase i / n; the period is 1. n >= 3.
  explicit PeriodicSpline(std::vector<double> values);
  double at(double phase) const;

 private:
  std::vector<double> x_, m_;  ///< values and second derivatives at the knots
};

}  // namespace gambeson
