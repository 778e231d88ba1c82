#pragma once
/// Tangents of solids that touch, factorised one after another: their sparsity goes with what touches.

#include <memory>
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
/// those that it was made for. Several solvers may work side by side, though not one by two threads: blocks are
/// eliminated by one of them at a time, since some builds of BLAS are not safe otherwise (Elimination).
class TangentSolver {
 public:
  TangentSolver();
  ~TangentSolver();
  TangentSolver(const TangentSolver&) = delete;
  TangentSolver& operator=(const TangentSolver&) = delete;

  /// K of these entries of both triangles, the diagonal raised by a part of it where K is symmetric. False where K is
  /// not finite or singular: nothing to solve with.
  bool factorise(std::span<const MatrixEntry> entries, int size, bool symmetric, double raise);
  /// x with K x = b, one step of iterative refinement.
  void solve(std::span<const double> b, std::span<double> x) const;

  /// Of the last K, where it was symmetric; else 0.
  int negativePivots() const { return negative_; }
  /// How many matrices were factorised, and how often one that is symmetric needed a symbolic part of its own.
  int factors() const { return factors_; }
  int analyses() const { return analyses_; }

 private:
  struct Unsymmetric;
  /// Puts the values where the kept sparsity has them; false where it lacks one.
  bool fits(const SymmetricMatrix& lower);

  SymmetricMatrix kept_;
  std::unique_ptr<SymmetricFactor> factor_;
  std::unique_ptr<Unsymmetric> unsymmetric_;  ///< where the last K was not symmetric
  int negative_ = 0, factors_ = 0, analyses_ = 0;
};

}  // namespace gambeson
