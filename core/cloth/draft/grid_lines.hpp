#pragma once
/// Where a place lies among the lines of a patch's grid, along one direction.

#include <algorithm>
#include <span>

namespace gambeson {

/// The cell that `at` lies in; of `lines`, ascending, two or more. Beyond the ends the first or the last.
inline int cellBetween(std::span<const double> lines, double at) {
  const auto above = std::upper_bound(lines.begin(), lines.end(), at);
  return std::clamp(static_cast<int>(above - lines.begin()) - 1, 0, static_cast<int>(lines.size()) - 2);
}

/// The line at exactly `at`, or -1.
inline int lineAt(std::span<const double> lines, double at) {
  const auto found = std::lower_bound(lines.begin(), lines.end(), at);
  return found != lines.end() && *found == at ? static_cast<int>(found - lines.begin()) : -1;
}

}  // namespace gambeson
