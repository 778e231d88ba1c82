#pragma once
/// How far cloth stands out between its samples.

#include <array>
#include <span>
#include <vector>

#include "core/math/sparse.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Along an edge of length h in the parameter, and along the diagonals of the grid of samples, the surface's middle
/// less the mean of the ends:
///     d = -h^2/8 x_uu;  -h_u^2/8 x_uu - h_v^2/8 x_vv -+ h_u h_v/4 x_uv,
/// by differences of samples, of the same cell where it has three along the edge: exact for quadratic surfaces, and to
/// O(h^4) for others. Rows over the samples; rows `of_sample` list the edges and diagonals that end at each: 1 for
/// edges of the surface's triangles, 0 for the diagonals across them. What trimming leaves no grid of has none.
struct Bulges {
  SparseRows middle;
  SparseRows of_sample;
  std::vector<std::array<int, 2>> ends;  ///< samples of each edge and diagonal

  /// How far the surface's middle lies from the mean of the ends of one edge or diagonal [m].
  Vec3 at(int row, std::span<const Vec3> x) const {
    Vec3 out{};
    for (int k = middle.offsets[row]; k < middle.offsets[row + 1]; ++k) out += middle.values[k] * x[middle.columns[k]];
    return out;
  }
  /// How far the surface beside a sample stands out in a direction (unit), at most; 0 where it does not [m]. `across`:
  /// in the middle of four samples too, beside those that no edge of a triangle leads to it from.
  double beside(int sample, const Vec3& direction, std::span<const Vec3> x, bool across = true) const;
};

}  // namespace gambeson
