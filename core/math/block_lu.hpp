#pragma once
/// Direct solution of sparse equations of 3 x 3 blocks that are not symmetric, small enough for one thread.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// A = L U of a square matrix of 3 x 3 blocks whose sparsity is symmetric and whose values need not be, in the order of
/// Amestoy, Davis and Duff (1996, approximate minimum degree). Pivots are the diagonal blocks in that order, without
/// exchanges: for matrices that are a positive definite one and something small beside it. What comes of others may be
/// far off: look at what A x leaves of b. One order of operations, so the same bits on any machine with one instruction
/// set; several factors may work side by side.
class BlockLu {
 public:
  /// Unknowns (of three numbers each) 0 to size - 1. Those of one group, members[offsets[g]] to members[offsets[g +
  /// 1]], are coupled with each other.
  BlockLu(int size, std::span<const int> offsets, std::span<const int> members);

  /// A = 0.
  void clear();
  /// A(row, column) += block, of unknowns of one group.
  void add(int row, int column, const Eigen::Matrix3d& block);
  /// Puts L and U in the place of A. False where a pivot is singular or not finite.
  bool factorise();
  /// x = A^-1 x, after factorise.
  void solve(std::span<Vec3> x) const;

 private:
  std::vector<int> place_;                                 ///< of each unknown in the order of elimination
  std::vector<int> offsets_;                               ///< of the columns of L (and rows of U), in that order
  std::vector<int> rows_;                                  ///< ascending, below the diagonal
  std::vector<Eigen::Matrix3d> lower_, upper_, diagonal_;  ///< pivots are inverted by factorise
};

}  // namespace gambeson
