#pragma once
/// Linear systems solved to the last digits where the matrix is ill-conditioned.

#include <span>

#include "core/math/cholesky.hpp"

namespace gambeson {

/// r = b - A x, rounded once: products and sums as if in twice the precision (Ogita, Rump and Oishi 2005, Dot2).
void residualOf(const SymmetricMatrix& A, std::span<const double> x, std::span<const double> b, std::span<double> r);

/// x = A^-1 b by the factor of A, refined with that residual until x stands: to the last digits for conditions of A up
/// to some 1e14.
void solveExactly(const SymmetricMatrix& A, const SymmetricFactor& factor, std::span<const double> b,
                  std::span<double> x);

}  // namespace gambeson
