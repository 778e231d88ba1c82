#include "core/math/quadrature.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace gambeson {

Quadrature gaussLegendre(int count) {
  assert(count >= 1);
  Quadrature rule;
  rule.points.resize(count);
  rule.weights.resize(count);
  for (int i = 0; i < count; ++i) {
    // Newton on the Legendre polynomial P_n, from the Chebyshev-like first guess.
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5));
    double slope = 1;
    for (int it = 0; it < 100; ++it) {
      double p0 = 1, p1 = x;
      for (int k = 2; k <= count; ++k) {
        const double p2 = ((2 * k - 1) * x * p1 - (k - 1) * p0) / k;
        p0 = p1;
        p1 = p2;
      }
      slope = count * (x * p1 - p0) / (x * x - 1);
      const double dx = p1 / slope;
      x -= dx;
      if (std::abs(dx) < 1e-15) break;
    }
    rule.points[i] = 0.5 * (1 + x);
    rule.weights[i] = 1 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace gambeson
