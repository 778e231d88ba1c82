#pragma once
/// Preconditioned conjugate gradients on vectors of blocks (Shewchuk 1994; Baraff and Witkin, SIGGRAPH 1998, for what
/// holds some of them). The same bits for any number of threads.

#include <functional>
#include <span>
#include <vector>

#include "core/math/block_matrix.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// A BlockMatrix as products want it: whole rows one after the other, without blocks that are zero. Each row is summed
/// by one thread in a fixed order.
class BlockProduct {
 public:
  BlockProduct() = default;
  explicit BlockProduct(const BlockMatrix& sparsity);
  /// Takes the values of a matrix of that sparsity.
  void set(const BlockMatrix& A);
  void multiply(std::span<const Vec3> x, std::span<Vec3> y) const;  ///< y = A x

 private:
  std::vector<long> offsets_;  ///< of the blocks by rows, left of the diagonal first
  std::vector<int> columns_;
  std::vector<long> block_;  ///< which of A's; those left of the diagonal are transposed
  // Of the values that were set, from offsets_[row] on.
  std::vector<int> used_, used_columns_;
  AlignedVector<double> values_;  ///< 12 a block: its columns, and a zero behind each
};

/// Inverses of symmetric 3 x 3 blocks, six values each (xx, yy, zz, xy, xz, yz).
class BlockInverses {
 public:
  /// From blocks of nine values row by row. False where one is not positive definite.
  bool set(std::span<const double> blocks);
  void multiply(std::span<const Vec3> x, std::span<Vec3> y) const;

 private:
  std::vector<double> values_;
};

/// What A x = b is solved with. `filter` is a projection that commutes with nothing: x stays in its range, what is left
/// of b is asked for there (null: all). `forces` is its transpose.
struct ConjugateGradients {
  std::function<void(std::span<const Vec3> x, std::span<Vec3> y)> multiply;
  std::function<void(std::span<const Vec3> r, std::span<Vec3> z)> precondition;
  std::function<void(std::span<Vec3>)> filter, forces;
};

struct CgReport {
  bool converged = false, positive = true;  ///< positive: no direction was met in which A is not
  int iterations = 0;
  double residual = 0;  ///< |r|/|b|, both by the preconditioner's norm sqrt(r . B^-1 r)
};

struct CgWork {
  std::vector<Vec3> r, z, p, Ap;
  std::vector<double> parts;
};

/// From x on, which the filter has been applied to, until the residual is `tolerance`.
CgReport solveCg(const ConjugateGradients& system, std::span<const Vec3> b, double tolerance, int most_iterations,
                 std::span<Vec3> x, CgWork& work);

}  // namespace gambeson
