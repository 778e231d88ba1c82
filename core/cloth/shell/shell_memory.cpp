#include "core/cloth/shell/shell_memory.hpp"

#include <algorithm>

namespace gambeson {

void ShellMemory::add(ShellBlock& block, const std::vector<SheetCell>& cells) {
  const long points = block.firstPoint(block.groups);
  block.history_at.assign(static_cast<std::size_t>(points * block.lanes), -1);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const int group = static_cast<int>(k) / block.lanes, lane = static_cast<int>(k) % block.lanes;
    const std::vector<CellPoint> own = cellRule(cells[k], block.gu, block.gv);
    for (std::size_t i = 0; i < own.size(); ++i) {
      const long point = block.firstPoint(group) + static_cast<long>(i), at = static_cast<long>(places_.size());
      block.history_at[static_cast<std::size_t>(point * block.lanes + lane)] = at * kHistoryDoubles;
      of_cell_[{cells[k].patch, cells[k].su, cells[k].sv}].push_back(at);
      places_.push_back({cells[k].patch, {own[i].u, own[i].v}});
    }
  }
}

const double* ShellMemory::nearest(int patch, std::array<int, 2> span, Vec2 uv, std::span<const double> history) const {
  const auto found = of_cell_.find({patch, span[0], span[1]});
  if (history.empty() || found == of_cell_.end()) return nullptr;
  const auto distance2 = [&](long at) {
    const Vec2 p = places_[static_cast<std::size_t>(at)].second;
    return (p.x - uv.x) * (p.x - uv.x) + (p.y - uv.y) * (p.y - uv.y);
  };
  const long at = *std::min_element(found->second.begin(), found->second.end(),
                                    [&](long a, long b) { return distance2(a) < distance2(b); });
  return history.data() + at * kHistoryDoubles;
}

}  // namespace gambeson
