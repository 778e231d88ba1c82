#pragma once
/// Where the Gauss points of a shell keep what their laws remember.

#include <array>
#include <map>
#include <vector>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/shell/shell_kernel.hpp"

namespace gambeson {

/// The history of a shell lists its Gauss points part by part as the blocks have them, lanes side by side, with as many
/// doubles as their laws need: an order of its instruction set. Empty where no law remembers.
class ShellMemory {
 public:
  /// Call once for each part, in order; `each`: doubles of each of its points. Sets block.history_first.
  void add(ShellBlock& block, const std::vector<SheetCell>& cells, int each);

  std::size_t doubles() const { return doubles_; }
  const std::vector<HistoryPlace>& places() const { return places_; }
  /// What the point of the cell at (patch, uv) that is nearest to there remembers; nothing where nothing is remembered.
  History<double> nearest(int patch, std::array<int, 2> span, Vec2 uv, std::span<const double> history) const;

 private:
  std::size_t doubles_ = 0;
  std::vector<HistoryPlace> places_;
  std::map<std::array<int, 3>, std::vector<std::size_t>> of_cell_;  ///< patch and knot spans: points
};

}  // namespace gambeson
