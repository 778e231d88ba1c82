#pragma once
/// Gauss-Legendre quadrature.

#include <vector>

namespace gambeson {

struct Quadrature {
  std::vector<double> points;   ///< in (0, 1), ascending
  std::vector<double> weights;  ///< sum to 1
};

/// The rule with `count` points on (0, 1), exact for polynomials of degree 2 count - 1. count >= 1.
Quadrature gaussLegendre(int count);

}  // namespace gambeson
