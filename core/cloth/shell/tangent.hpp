#pragma once
/// The consistent tangent of a sheet on its free points, assembled in a fixed order.

#include "core/cloth/draft/seams.hpp"
#include "core/cloth/shell/shell.hpp"
#include "core/math/block_matrix.hpp"

namespace gambeson {

/// K = Tᵀ (d2E/dq2) T, material and geometric parts of cells and seams. The sparsity and the gather lists are built
/// once; values come from each element's own block in a fixed order, so that the bits do not depend on threads.
/// Elements are worked off in batches that fit the cache, so that the scratch does not grow with the sheet.
class Tangent {
 public:
  Tangent(const Shell& shell, const FreeMap& map);
  /// Every pair of free points that share a cell (or a seam point) is in the sparsity.
  const BlockMatrix& sparsity() const { return sparsity_; }
  /// Writes K at the control points q. `terms` as in Shell::force. `shell` is the one of the constructor.
  void assemble(const Shell& shell, const ClothState& state, ClothWork& work, BlockMatrix& K,
                const ForceTerms& terms = {}) const;

 private:
  /// Groups of one part of the shell, or points of its seams.
  struct Batch {
    enum Kind { cells, hinges, gaps } kind = cells;
    int part = 0, first = 0, count = 0;
    int stride = 1;    ///< between the nine values of a pair
    long doubles = 0;  ///< of scratch
    long first_sum = 0, end_sum = 0;
  };
  /// A pair's contribution to a block of K.
  struct Source {
    int slot = 0;  ///< first of nine values in ClothWork::tangent_slots
    bool transposed = false;
    double weight = 0;  ///< product of the entries of T
  };
  void addSeamBatches(const FreeMap& map, Batch::Kind kind, const std::vector<const std::vector<int>*>& columns);
  void addBatch(const FreeMap& map, const Batch& batch, const std::vector<std::pair<std::vector<int>, int>>& elements);

  BlockMatrix sparsity_;
  std::vector<Batch> batches_;
  std::vector<long> sum_block_;       ///< block of K that a sum goes to
  std::vector<long> sum_offsets_{0};  ///< its sources
  std::vector<Source> sources_;
  std::vector<long> seam_slot_[3];  ///< of each hinge and of each gap in its batch
};

}  // namespace gambeson
