#pragma once
/// Seams that hold points of equal fraction of length of two edges together, as linear conditions on a cloth's points.

#include <vector>

#include "core/math/sparse.hpp"

namespace gambeson {

/// Conditions C q = 0. Row k is the mean gap of its seam under a hat over the fraction s of its length,
///   g_k = ∫ phi_k(s) (x_a(s) - x_b(s)) ds / ∫ phi_k(s) ds   [m],
/// by one quadrature for both sides. Entries of a row sum to 0: a force C^T lambda moves nothing as a whole, and its
/// moment is g_k x lambda_k summed, nothing where the conditions hold: both momenta are kept, whatever gap is left
/// between the points. Rows may depend on each other (where seams meet at a corner).
struct SewnRows {
  SparseRows C;                  ///< rows x points
  std::vector<double> length_m;  ///< of seam that each row stands for, the mean of both sides
  std::vector<double> hat_m;     ///< from each hat to the next
  std::vector<int> seam;         ///< that each row belongs to
  /// The gap x_a - x_b at points all along the seams, for whoever wants to know how far they gape between the hats.
  SparseRows pairs;
  std::vector<double> cell_m;  ///< of each pair: the shorter side of the smaller of both cells at rest

  int rows() const { return C.rows(); }
  bool empty() const { return rows() == 0; }
};

}  // namespace gambeson
