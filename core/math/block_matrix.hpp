#pragma once
/// Symmetric sparse matrices of 3 x 3 blocks, one block row per point.

#include <array>
#include <vector>

#include "core/math/aligned.hpp"

namespace gambeson {

/// The upper triangle by block rows: row r holds columns[k] >= r, ascending, offsets[r] <= k < offsets[r + 1]. Every
/// diagonal block is there. values: 9 per block, row by row; diagonal blocks are held whole.
struct BlockMatrix {
  std::vector<long> offsets{0};
  std::vector<int> columns;
  AlignedVector<double> values;

  int rows() const { return static_cast<int>(offsets.size()) - 1; }
  /// Index of block (r, c), r <= c, in `columns`; -1 where it is not in the sparsity.
  long find(int r, int c) const;
  /// Adds a block (row by row) at (r, c); for r > c its transpose is added at (c, r). The block is in the sparsity.
  void add(int r, int c, const std::array<double, 9>& block);
};

}  // namespace gambeson
