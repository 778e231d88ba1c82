#pragma once
/// From the blocks of the free points to the scalar matrix of the unknowns: Cᵀ K C.

#include <span>
#include <vector>

#include "core/math/block_matrix.hpp"
#include "core/math/cholesky.hpp"
#include "core/math/sparse.hpp"

namespace gambeson {

/// The gather lists are built once; each entry sums its sources in a fixed order. Where supports only hold components
/// the reduction is a selection, one source per entry.
class Reduction {
 public:
  /// K has 3 x 3 blocks, C has 3 rows per block row.
  Reduction(const BlockMatrix& K, const SparseRows& C);
  const SymmetricMatrix& sparsity() const { return sparsity_; }
  /// out has the sparsity.
  void reduce(const BlockMatrix& K, SymmetricMatrix& out) const;

 private:
  SymmetricMatrix sparsity_;
  std::vector<long> offsets_;    ///< of each entry's sources; empty where each has one
  std::vector<int> sources_;     ///< index in K.values
  std::vector<double> weights_;  ///< empty where all are 1
};

/// y = K x, x with 3 components per block row.
void multiply(const BlockMatrix& K, std::span<const double> x, std::span<double> y);

}  // namespace gambeson
