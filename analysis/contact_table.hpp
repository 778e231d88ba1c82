#pragma once
/// Where on the body the cloth presses: force and share of each segment.

#include <span>
#include <string>
#include <vector>

#include "analysis/torque.hpp"

namespace gambeson {

/// What one segment (a link with a shape) received. The force of a window is the vector impulse over its duration, so
/// opposite pressures on one segment cancel; `share` is that of ∫|F|dt among the segments.
struct ContactShare {
  int link = 0;
  std::string segment;
  double impulse_Ns = 0;  ///< ∫ |F| dt over the windows
  double share = 0;       ///< of the sum over the segments; 0 where nothing touched
  double mean_N = 0, peak_N = 0, peak_time_s = 0;
};

/// The links that carry a shape, ascending.
std::vector<int> segmentLinks(const Human& human);

std::vector<ContactShare> contactShares(const Human& human, std::span<const ContactWindow> windows);

}  // namespace gambeson
