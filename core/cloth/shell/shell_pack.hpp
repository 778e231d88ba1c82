#pragma once
/// Packs cells into the blocks that the kernels of a shell work on (lanes = cells).

#include <array>
#include <optional>
#include <vector>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/garment.hpp"
#include "core/cloth/shell/shell_kernel.hpp"

namespace gambeson {

/// What cells of one block share.
struct BlockKind {
  int p, q;
  bool rational, scattered;
  std::optional<int> fabric;       ///< fabricOfPatch
  bool assumed, fewer_u, fewer_v;  ///< assumed strains; a Gauss point less along u, along v
  auto operator<=>(const BlockKind&) const = default;
};

/// `offsets`: of the patches among all control points. A last group that is not full is filled up by copies without
/// area.
ShellBlock packBlock(const Garment& garment, const std::vector<int>& offsets, const BlockKind& kind,
                     const std::vector<SheetCell>& cells, int lanes, int gauss_extra);

/// Basis functions of a cell at a point: of its spans, also on its border.
struct CellBasis {
  std::vector<double> u, v;                     ///< of the knots: [derivative][function]
  std::array<double, 6> denominator{};          ///< and its derivatives: w, 1, 2, 11, 22, 12
  std::array<std::vector<double>, 6> rational;  ///< N, N,1 N,2 N,11 N,22 N,12
  std::array<Vec3, 6> rest{};                   ///< X and its derivatives
};

CellBasis cellBasis(const NurbsPatch& patch, const SheetCell& cell, double u, double v);

/// The places of the assumed strains of a cell, in the order of the kernels' Ties, and their weights.
void packTies(const Garment& garment, const SheetCell& cell, ShellBlock& b, long group, int lane);

}  // namespace gambeson
