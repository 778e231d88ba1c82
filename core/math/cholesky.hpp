#pragma once
/// Sparse direct factorisation of symmetric matrices by CHOLMOD (SuiteSparse), with the symbolic part kept.

#include <memory>
#include <span>
#include <vector>

namespace gambeson {

/// The lower triangle of a symmetric matrix by columns (row indices ascending, the diagonal present).
struct SymmetricMatrix {
  int size = 0;
  std::vector<int> offsets{0};
  std::vector<int> rows;
  std::vector<double> values;
};

/// y = A x, in a fixed order.
void multiply(const SymmetricMatrix& a, std::span<const double> x, std::span<double> y);

/// singular: a pivot is zero to rounding (below 1e-14 of its diagonal entry).
enum class Definiteness { positive, indefinite, singular };

/// How a matrix is eliminated: in blocks (supernodal, by BLAS), which is fast for large ones, or entry by entry without
/// BLAS. Factors of their own may work side by side only entry by entry: some builds of BLAS (OpenBLAS without threads,
/// as Debian has it) share their buffers between callers and answer wrongly.
enum class Elimination { blocks, entries };

/// Analyses the sparsity once; `factorise` may be called as often as values change. Not for use by two threads at once.
class SymmetricFactor {
 public:
  explicit SymmetricFactor(const SymmetricMatrix& sparsity, Elimination elimination = Elimination::blocks);
  ~SymmetricFactor();
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

  /// Supernodal Cholesky; entry by entry, or where that meets a pivot that is not positive, simplicial L D Lᵀ (no pivoting: static
  /// condensation may lose digits where leading minors nearly vanish; `solve` refines against the matrix). Throws
  /// RunError where a value is not finite or memory runs out.
  Definiteness factorise(const SymmetricMatrix& matrix);
  /// How many eigenvalues of the matrix are negative: those of D (Sylvester). Valid after factorise.
  int negativePivots() const;
  /// The unknown with the smallest pivot relative to its diagonal: what a mechanism moves.
  int weakestUnknown() const;
  /// The smallest |pivot|.
  double smallestPivot() const;
  /// False after a pivot that is exactly zero: nothing to solve with.
  bool solvable() const;
  /// x = K^-1 b, one step of iterative refinement. b and x are different vectors.
  void solve(std::span<const double> b, std::span<double> x) const;
  /// The same without refinement, in half of the time.
  void solveOnce(std::span<const double> b, std::span<double> x) const;

  /// The unknowns that solveWanted is about, until the next call.
  void want(std::span<const int> unknowns);
  /// solveOnce where b is zero but at the wanted unknowns and x matters there alone: b and x hold these, in their order.
  /// Visits the columns of the factor that they reach.
  void solveWanted(std::span<const double> b, std::span<double> x) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace gambeson
