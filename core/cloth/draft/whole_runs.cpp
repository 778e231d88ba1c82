#include "core/cloth/draft/whole_runs.hpp"

#include <algorithm>

namespace gambeson {

WholeRuns::WholeRuns(const Garment& garment, std::span<const SheetCell> cells) : garment_(garment) {
  for (const SheetCell& c : cells) {
    if (c.cut) continue;
    low_.insert({c.patch, c.u0, c.v0});
    next_u_.insert({c.patch, c.u1, c.v0});
    next_v_.insert({c.patch, c.u0, c.v1});
  }
}

bool WholeRuns::along(const SheetCell& c, int direction) const {
  if (c.cut) return false;
  const NurbsPatch& patch = garment_.patches[static_cast<std::size_t>(c.patch)];
  const std::vector<double>& knots = (direction == 0 ? patch.u : patch.v).knots;
  const auto simple = [&](double knot) { return std::count(knots.begin(), knots.end(), knot) == 1; };
  if (direction == 0)
    return (simple(c.u1) && low_.contains({c.patch, c.u1, c.v0})) ||
           (simple(c.u0) && next_u_.contains({c.patch, c.u0, c.v0}));
  return (simple(c.v1) && low_.contains({c.patch, c.u0, c.v1})) ||
         (simple(c.v0) && next_v_.contains({c.patch, c.u0, c.v0}));
}

bool isPanel(const Garment& garment, int patch) {
  const auto takes = [&](const SewnEdge& edge) {
    return std::any_of(edge.begin(), edge.end(), [&](const SewnPart& part) { return part.patch == patch; });
  };
  return std::any_of(garment.sewn_seams.begin(), garment.sewn_seams.end(),
                     [&](const SewnSeam& seam) { return takes(seam.a) || takes(seam.b); });
}

}  // namespace gambeson
