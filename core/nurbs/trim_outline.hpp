#pragma once
/// The cells of a sample grid cut by trimming loops, as polygons that share their vertices.

#include <span>
#include <vector>

#include "core/nurbs/trim_arcs.hpp"

namespace gambeson {

/// What a vertex may do when vertices merge.
enum class OutlineRank {
  inner,   ///< a grid sample inside
  edge,    ///< on a loop or on the patch's border: moves along it only
  corner,  ///< of a loop, of the patch, or where both meet: stays
};

struct Outline {
  std::vector<Vec2> uv;
  std::vector<OutlineRank> rank;
  std::vector<int> grid;  ///< the vertex of each grid point (u fastest), or -1
  struct Cell {
    int i = 0, j = 0;
    bool whole = false;                      ///< the four corners, nothing else
    std::vector<std::vector<int>> polygons;  ///< counter-clockwise, simple but for bridges to holes
  };
  std::vector<Cell> cells;  ///< with something kept, u fastest
};

/// Loops become polygons with vertices where they meet the grid lines us x vs, at their corners, and between, so that
/// chords stay within about 0.05 of a cell of the loop; a loop within a cell has at least 8.
Outline cutGrid(const TrimBoundary& boundary, std::span<const double> us, std::span<const double> vs);

}  // namespace gambeson
