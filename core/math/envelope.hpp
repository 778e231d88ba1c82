#pragma once
/// Cholesky factor of a symmetric matrix within its envelope, constant once it is made: any number of threads may solve
/// with one factor, and each of them gets the same bits.

#include <span>
#include <vector>

#include "core/math/cholesky.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// K = L L^T of a positive semi-definite matrix in the order of reverse Cuthill and McKee (1969). A row whose pivot is
/// below `dependent` of its diagonal follows from the rows before it: it is left out, and its unknown is 0, which
/// solves K x = b for every b that K makes.
class EnvelopeFactor {
 public:
  EnvelopeFactor() = default;
  explicit EnvelopeFactor(const SymmetricMatrix& K, double dependent = 1e-6);

  int size() const { return static_cast<int>(order_.size()); }
  int leftOut() const { return left_out_; }
  /// x = K^-1 x, of three right sides at once. `scratch`: of the caller.
  void solve(std::span<Vec3> x, std::vector<Vec3>& scratch) const;

 private:
  std::vector<int> order_;     ///< old number of each row
  std::vector<int> first_;     ///< column of the first entry of each row
  std::vector<long> offsets_;  ///< of the rows' entries, the diagonal last
  std::vector<double> values_;
  int left_out_ = 0;
};

}  // namespace gambeson
