#pragma once
/// Climbing stairs.

#include "human/motion/motion.hpp"

namespace gambeson {

/// What climbing stairs is made of.
struct StairOptions {
  double stand_s = 0;       ///< time at rest before the lead-in
  double lead_in_s = 0.6;   ///< the first step, from standing; 0.4 to 0.7 strides' time
  int strides = 2;          ///< of two steps each, after the lead-in
  int lead_in_strides = 1;  ///< how many of them come before what is measured
  double stride_time_s = 1.2;
  double measuredFrom_s() const { return stand_s + lead_in_s + lead_in_strides * stride_time_s; }
};
/// Climbing stairs (Bovi et al. 2011, human/motion/stairs.cpp); Motion::stairs() has the stairs that the steps imply.
std::unique_ptr<Motion> makeStairs(const Human& human, const StairOptions& options, Vec3* mean_velocity = nullptr);

}  // namespace gambeson
