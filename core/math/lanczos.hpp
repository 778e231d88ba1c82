#pragma once
/// Lanczos with full orthogonalisation, for the largest eigenvalues of an operator that is self-adjoint in the inner
/// product of M (Parlett 1998, chapter 13).

#include <functional>
#include <span>
#include <vector>

namespace gambeson {

using LinearOperator = std::function<void(std::span<const double> x, std::span<double> y)>;

struct RitzPair {
  double value = 0;
  double error = 0;            ///< |A x - value x| in M's norm
  std::vector<double> vector;  ///< of M's norm 1
};

struct LanczosOptions {
  int wanted = 1;            ///< stops once so many of the largest values have converged
  double tolerance = 1e-10;  ///< of the error against the value (not below rounding of the largest)
  int most_steps = 200;
};

/// The `wanted` largest eigenvalues, largest first (fewer where the space is exhausted). Looks only in the complement
/// of `against` (vectors of M's norm 1, orthogonal to one another). A start vector sees a repeated eigenvalue once: run
/// again against what was found to see the others.
std::vector<RitzPair> lanczosLargest(const LinearOperator& A, const LinearOperator& M, std::vector<double> start,
                                     std::span<const RitzPair> against, const LanczosOptions& options);

/// Fixed numbers in (-1, 1), so that a start vector is blind to no mode.
std::vector<double> scatteredVector(int size, unsigned seed);

}  // namespace gambeson
