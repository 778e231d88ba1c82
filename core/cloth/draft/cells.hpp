#pragma once
/// The cells of a garment over which the shell, its mass and its loads are integrated.

#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// A knot cell, or what trimming leaves of it.
struct SheetCell {
  int patch = 0;
  int su = 0, sv = 0;  ///< knot spans
  double u0 = 0, u1 = 0, v0 = 0, v1 = 0;
  bool cut = false;
  std::vector<CellPoint>
      points;  ///< of a cut cell: its own rule. A whole cell takes a tensor rule of the user's choice.
};

/// Throws InputError unless `trims` is empty or holds one entry per patch.
void checkTrims(const Garment& garment);
/// Whether a patch has trimming loops.
bool isTrimmed(const Garment& garment, int patch);

/// Cells outside the trimming loops are left out. Order: patch by patch, u fastest.
std::vector<SheetCell> sheetCells(const Garment& garment);

/// The points of a cell: its own, or `per_direction_u` x `per_direction_v` Gauss points.
std::vector<CellPoint> cellRule(const SheetCell& cell, int per_direction_u, int per_direction_v);

}  // namespace gambeson
