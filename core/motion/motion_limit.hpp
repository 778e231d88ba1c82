#pragma once
/// Limits that hold at the end of explicit steps, as the integrator sees them.

#include <span>
#include <vector>

#include "core/motion/strain_limit.hpp"

namespace gambeson {

class MotionLimit {
 public:
  virtual ~MotionLimit() = default;
  /// Moves the unknowns y, where a step of dt ends at time t, onto the limits, and writes what it added. The
  /// multipliers [J] come as those of the step before (empty: none) and leave as those of this step.
  virtual LimitReport project(double t, double dt, std::span<double> y, std::span<double> change,
                              std::vector<double>& multiplier_J) = 0;
  /// M^-1 times the force of the limits at (y, t).
  virtual void acceleration(std::span<const double> y, double t, std::span<const double> multiplier_J,
                            std::span<double> a) = 0;
};

}  // namespace gambeson
