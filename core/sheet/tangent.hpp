#pragma once
/// The consistent tangent of a sheet on its free points, assembled in a fixed order.

#include "core/math/block_matrix.hpp"
#include "core/sheet/seams.hpp"
#include "core/sheet/shell.hpp"

namespace gambeson {

/// K = Tᵀ (d2E/dq2) T, material and geometric parts of cells and seams. The pattern and the gather lists are built
/// once; values come from each element's own block in a fixed order, so that the bits do not depend on threads.
class Tangent {
 public:
  Tangent(const Shell& shell, const FreeMap& map);
  /// Every pair of free points that share a cell (or a seam point) is in the pattern.
  const BlockMatrix& pattern() const { return pattern_; }
  /// Writes K at the control points q. `terms` as in Shell::force.
  void assemble(const Shell& shell, std::span<const Vec3> q, ShellWork& work, BlockMatrix& K,
                const ShellTerms& terms = {}) const;

 private:
  BlockMatrix pattern_;
  std::vector<long> gather_offsets_;  ///< of each block
  struct Source {
    long slot;   ///< first of nine values in ShellWork::tangent_slots
    int stride;  ///< between them
    bool transposed;
    double weight;  ///< product of the entries of T
  };
  std::vector<Source> sources_;
};

}  // namespace gambeson
