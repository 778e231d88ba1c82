#pragma once
/// What kernels read of a shell, as arrays, made once from core's.

#include <optional>
#include <string>
#include <vector>

#include "core/cloth/shell/shell.hpp"
#include "gpu/forces/cell_kernel.hpp"
#include "gpu/forces/quad_kernels.hpp"
#include "gpu/forces/seam_kernels.hpp"

namespace gambeson::gpu {

/// Patches of quadratic cells with 2 x 2 points and a plain law.
struct FlatQuads {
  std::vector<QuadSheet> sheets;
  std::vector<int> function_u, function_v;
  std::vector<double> basis_u, basis_v, rest;
  std::vector<Touched> touched_u, touched_v;
  std::vector<PlainNumbers> laws;       ///< of each sheet
  std::vector<PointLaw> points;         ///< likewise, as core has them
  std::vector<const BlockLaw*> blocks;  ///< likewise, of the blocks that they come from
  long cells = 0;
};

struct FlatShell {
  int points = 0;
  std::vector<double> weights;  ///< of the control points, as positions carry them
  FlatQuads quads;
  std::vector<FlatCells> cells;  ///< all others, a list for each kind
  FlatSeams seams;
  int slots = 0;                           ///< that cells and seams write to
  std::vector<int> first_slot, slot_list;  ///< of each control point; empty where there are none
  std::vector<int> gathered;               ///< control points that no quad sheet sums
  long gauss_points = 0;
};

FlatShell flatShell(const Shell& shell, bool general_alone = false);

/// The laws of a flat shell where something is left out, or taken at its steepest; all else of it stays.
struct FlatLaws {
  struct OfCells {
    PointNumbers<double> law{};
    std::vector<double> laws;  ///< of the points, where they differ
    LawUse use;
  };
  std::vector<PlainNumbers> sheets;
  std::vector<OfCells> cells;
};
FlatLaws flatLaws(const FlatShell& flat, const ForceTerms& terms);

/// What of a shell is not carried; none: all is.
std::optional<std::string> notCarried(const Shell& shell);

/// Work of blocks: all control points of all sheets, `cells_u` x `cells_v` cells a block (tiles), or strips of so many
/// rows of control points (cells_v 0).
std::vector<QuadWork> tilesOf(const FlatQuads& quads, int cells_u, int cells_v);
std::vector<QuadWork> stripsOf(const FlatQuads& quads, int cells_u, int rows);

}  // namespace gambeson::gpu
