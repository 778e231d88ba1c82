#include "core/math/exact_solve.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace gambeson {
namespace {

/// A sum and what its rounding lost.
struct Compensated {
  double sum = 0, lost = 0;
  void add(double a, double b) {
    const double product = a * b, next = sum + product, part = next - sum;
    lost += (sum - (next - part)) + (product - part) + std::fma(a, b, -product);
    sum = next;
  }
};

double sizeOf(std::span<const double> x) {
  double sum = 0;
  for (double v : x) sum += v * v;
  return std::sqrt(sum);
}

}  // namespace

void residualOf(const SymmetricMatrix& A, std::span<const double> x, std::span<const double> b, std::span<double> r) {
  std::vector<Compensated> sums(b.size());
  for (std::size_t i = 0; i < b.size(); ++i) sums[i].sum = b[i];
  for (int c = 0; c < A.size; ++c)
    for (int k = A.offsets[c]; k < A.offsets[c + 1]; ++k) {
      const int row = A.rows[k];
      sums[c].add(-A.values[k], x[row]);
      if (row != c) sums[row].add(-A.values[k], x[c]);
    }
  for (std::size_t i = 0; i < b.size(); ++i) r[i] = sums[i].sum + sums[i].lost;
}

void solveExactly(const SymmetricMatrix& A, const SymmetricFactor& factor, std::span<const double> b,
                  std::span<double> x) {
  constexpr int kMost = 12;
  factor.solve(b, x);
  std::vector<double> residual(b.size()), correction(b.size());
  double before = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMost; ++k) {
    residualOf(A, x, b, residual);
    factor.solve(residual, correction);
    const double size = sizeOf(correction);
    if (!(size < 0.5 * before)) return;  // it stands, or does not converge
    for (std::size_t i = 0; i < b.size(); ++i) x[i] += correction[i];
    if (size <= std::numeric_limits<double>::epsilon() * sizeOf(x)) return;
    before = size;
  }
}

}  // namespace gambeson
