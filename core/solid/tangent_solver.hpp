#pragma once
/// Tangents of solids that touch, factorised one after another: their sparsity goes with what touches.

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/math/cholesky.hpp"

namespace gambeson {

struct MatrixEntry {
  int row, column;
  double value;
};

/// The lower triangle of what both triangles' entries add up to.
SymmetricMatrix lowerTriangle(std::span<const MatrixEntry> entries, int size);

/// Keeps the symbolic part of the last factor, and takes it again for every symmetric matrix whose entries are among
/// those that it was made for. Not for use by two threads at once.
class TangentSolver {
 public:
  explicit TangentSolver(Elimination elimination = Elimination::blocks) : elimination_(elimination) {}

  /// x with K x = b, K of these entries of both triangles, the diagonal raised by a part of it where K is symmetric;
  /// none where K is not finite or singular.
  std::optional<std::vector<double>> solve(std::span<const MatrixEntry> entries, std::span<const double> b,
                                           bool symmetric, double raise);
  /// Of the last K, where it was symmetric; else 0.
  int negativePivots() const { return negative_; }
  /// How often a sparsity was analysed, of how many factors.
  int analyses() const { return analyses_; }
  int factors() const { return factors_; }

 private:
  /// Puts the values where the kept sparsity has them; false where it lacks one.
  bool fits(const SymmetricMatrix& lower);

  Elimination elimination_;
  SymmetricMatrix kept_;
  std::unique_ptr<SymmetricFactor> factor_;
  int negative_ = 0, analyses_ = 0, factors_ = 0;
};

}  // namespace gambeson
