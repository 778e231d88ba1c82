#pragma once
/// Where the Gauss points of a shell keep what their laws remember.

#include <array>
#include <map>
#include <vector>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/shell/shell_kernel.hpp"

namespace gambeson {

/// The history of a shell lists its Gauss points part by part, cell by cell, kHistoryDoubles each: an order that no
/// instruction set changes. Empty where no law remembers.
class ShellMemory {
 public:
  /// Call once for each part, in order. Sets block.history_at.
  void add(ShellBlock& block, const std::vector<SheetCell>& cells);

  std::size_t doubles() const { return places_.size() * kHistoryDoubles; }
  /// Patch and parameters of each point of the list.
  const std::vector<std::pair<int, Vec2>>& places() const { return places_; }
  /// What the point of the cell at (patch, uv) that is nearest to there remembers; null where nothing is remembered.
  const double* nearest(int patch, std::array<int, 2> span, Vec2 uv, std::span<const double> history) const;

 private:
  std::vector<std::pair<int, Vec2>> places_;
  std::map<std::array<int, 3>, std::vector<long>> of_cell_;  ///< patch and knot spans: points
};

}  // namespace gambeson
