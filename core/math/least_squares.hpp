#pragma once
/// Numbers that fit measurements best, and how well these determine them.

#include <functional>
#include <span>
#include <vector>

namespace gambeson {

struct LeastSquares {
  std::vector<double> value;
  std::vector<double> error;  ///< one standard deviation of each
  double rms = 0;             ///< of the residuals
};

/// Writes the residuals of `count` measurements at numbers x.
using Residuals = std::function<void(std::span<const double> x, std::span<double> residuals)>;

/// x that makes the sum of squared residuals least, from a start near it, by Levenberg and Marquardt's iteration
/// (Eigen's, after MINPACK: J. More, Lecture Notes in Mathematics 630, 105, 1978), with differences for the Jacobian J.
/// Errors are those of the linear theory at x: the square roots of the diagonal of s^2 (J^T J)^-1, s^2 = sum r^2/(count
/// - n). They hold for independent errors of one size and residuals that are about linear in x within the errors; of
/// few measurements the distribution is Student's with count - n degrees of freedom, wider than Gauss'. No start may be
/// 0: it is the unit of its number. Throws InputError (reason only) where count <= n, a residual is not finite, or
/// measurements do not determine the numbers (J^T J is singular).
LeastSquares leastSquares(const Residuals& residuals, int count, const std::vector<double>& start);

}  // namespace gambeson
