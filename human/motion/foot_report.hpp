#pragma once
/// Whether a motion's feet could stand on the ground.

#include <limits>
#include <optional>

#include "human/motion/motion.hpp"

namespace gambeson {

struct FootReport {
  double slip_m_per_s = 0, slip_time_s = 0;          ///< largest horizontal speed of the stance foot's lowest point
  double slip_m = 0;                                 ///< longest way that it slips while one foot carries
  double penetration_m = 0, penetration_time_s = 0;  ///< deepest that a foot enters the ground or a step
  double hover_m = 0, hover_time_s = 0;              ///< highest that both feet are above it at once
};

/// Of all shapes on links whose name begins with "foot", against the motion's stairs or the ground z = 0, every
/// `step_s` up to the motion's end, or until_s. The stance foot is the slowest of those within 5 mm of it or below.
/// None where the human has no feet.
std::optional<FootReport> footReport(const Human& human, const Motion& motion,
                                     double until_s = std::numeric_limits<double>::infinity(), double step_s = 0.005);

}  // namespace gambeson
