#pragma once
/// Walking at natural speed.

#include "human/motion/motion.hpp"

namespace gambeson {

/// What walking is made of.
struct WalkOptions {
  double stand_s = 0;      ///< time at rest before the lead-in
  double lead_in_s = 0.5;  ///< smooth start from standing
  int strides = 2;
  int paces = 0;  ///< single steps after the lead-in in place of strides; 0: strides count
  double stride_time_s = 1.10;
  double strideCount() const { return paces > 0 ? 0.5 * paces : strides; }
};
/// Walking at natural speed (Bovi et al. 2011, closed to a period). `mean_velocity` returns the pelvis's mean velocity
/// over a stride [m/s].
std::unique_ptr<Motion> makeWalk(const Human& human, const WalkOptions& options, Vec3* mean_velocity = nullptr);

}  // namespace gambeson
