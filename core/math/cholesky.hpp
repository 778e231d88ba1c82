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

enum class Definiteness { positive, indefinite, singular };

/// Analyses the pattern once; `factorise` may be called as often as values change.
class SymmetricFactor {
 public:
  explicit SymmetricFactor(const SymmetricMatrix& pattern);
  ~SymmetricFactor();
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

  /// Supernodal Cholesky; where that meets a pivot that is not positive, simplicial L D Lᵀ (no pivoting: static
  /// condensation may lose digits where leading minors nearly vanish; `solve` refines against the matrix).
  Definiteness factorise(const SymmetricMatrix& matrix);
  /// Of D: how many eigenvalues are negative (Sylvester). Valid after factorise.
  int negativePivots() const;
  /// The unknown with the smallest pivot relative to its diagonal: what a mechanism moves.
  int weakestUnknown() const;
  /// x = K^-1 b, one step of iterative refinement.
  void solve(std::span<const double> b, std::span<double> x) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> self_;
};

}  // namespace gambeson
