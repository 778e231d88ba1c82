#include "core/cloth/shell/shell_memory.hpp"

#include <algorithm>

namespace gambeson {

void ShellMemory::add(ShellBlock& block, const std::vector<SheetCell>& cells, int each) {
  block.history_first = static_cast<long>(doubles_);
  if (each == 0) return;
  const auto lanes = static_cast<std::size_t>(block.lanes), count = static_cast<std::size_t>(each);
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const std::size_t group = k / lanes, lane = k % lanes;
    const std::vector<CellPoint> own = cellRule(cells[k], block.gu, block.gv);
    for (std::size_t i = 0; i < own.size(); ++i) {
      const std::size_t point = static_cast<std::size_t>(block.firstPoint(static_cast<int>(group))) + i;
      of_cell_[{cells[k].patch, cells[k].su, cells[k].sv}].push_back(places_.size());
      places_.push_back({cells[k].patch, {own[i].u, own[i].v}, doubles_ + point * count * lanes + lane, count, lanes});
    }
  }
  doubles_ += static_cast<std::size_t>(block.firstPoint(block.groups)) * count * lanes;
}

History<double> ShellMemory::nearest(int patch, std::array<int, 2> span, Vec2 uv,
                                     std::span<const double> history) const {
  const auto found = of_cell_.find({patch, span[0], span[1]});
  if (history.empty() || found == of_cell_.end()) return {};
  const auto distance2 = [&](std::size_t at) {
    const Vec2 p = places_[at].place;
    return (p.x - uv.x) * (p.x - uv.x) + (p.y - uv.y) * (p.y - uv.y);
  };
  const std::size_t at = *std::min_element(found->second.begin(), found->second.end(),
                                           [&](std::size_t a, std::size_t b) { return distance2(a) < distance2(b); });
  return {history.data() + places_[at].first, nullptr, static_cast<long>(places_[at].stride)};
}

}  // namespace gambeson
