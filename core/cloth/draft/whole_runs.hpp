#pragma once
/// Which cells of a trimmed patch have a whole neighbour along u or v, so that two points a cell see all quadratics.

#include <set>
#include <span>
#include <tuple>

#include "core/cloth/draft/cells.hpp"

namespace gambeson {

/// Of the whole cells of quadratic patches. Two points a cell see nothing of f = c (s - s1)(s - s2); a neighbour in the
/// row with which the cell joins by a simple knot makes c = 0, and one along the other direction too where both have
/// one (core/cloth/shell/shell.cpp, twoPointsSeeAll). What is left of a cut cell may be too little to see it.
class WholeRuns {
 public:
  WholeRuns(const Garment& garment, std::span<const SheetCell> cells);
  bool alongU(const SheetCell& cell) const { return along(cell, 0); }
  bool alongV(const SheetCell& cell) const { return along(cell, 1); }

 private:
  using Corner = std::tuple<int, double, double>;  ///< patch, and a corner of a cell
  bool along(const SheetCell& cell, int direction) const;

  const Garment& garment_;
  std::set<Corner> low_;              ///< corners (u0, v0) of the whole cells
  std::set<Corner> next_u_, next_v_;  ///< their corners (u1, v0) and (u0, v1)
};

/// Whether a sewn seam takes hold of a patch.
bool isPanel(const Garment& garment, int patch);

}  // namespace gambeson
