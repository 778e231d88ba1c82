#pragma once
/// Plane tensors: sums, principal values, and true stress from the conjugate of the Green-Lagrange strain.

#include <array>
#include <cmath>

#include "core/cloth/stress.hpp"

namespace gambeson {

inline void addScaled(PlaneTensor& sum, double w, const PlaneTensor& t) {
  sum.t11 += w * t.t11;
  sum.t22 += w * t.t22;
  sum.t12 += w * t.t12;
}

/// Larger, smaller.
inline std::array<double, 2> principalValues(const PlaneTensor& t) {
  const double mean = 0.5 * (t.t11 + t.t22), radius = std::hypot(0.5 * (t.t11 - t.t22), t.t12);
  return {mean + radius, mean - radius};
}

/// True (Cauchy) resultants [N/m] of strains (E11, E22, 2 E12) and second Piola-Kirchhoff resultants n: with C = 2 E +
/// 1 and U its root, F n Fᵀ/J is U n U/J, turned.
inline PlaneTensor cauchyStress(const Vec3& strain, const Vec3& n) {
  const double C11 = 2 * strain.x + 1, C22 = 2 * strain.y + 1, C12 = 2 * (0.5 * strain.z);
  const double J = std::sqrt(C11 * C22 - C12 * C12), scale = 1 / std::sqrt(C11 + C22 + 2 * J);
  const double U11 = scale * (C11 + J), U22 = scale * (C22 + J), U12 = scale * C12;
  const double a11 = U11 * n.x + U12 * n.z, a12 = U11 * n.z + U12 * n.y, a21 = U12 * n.x + U22 * n.z,
               a22 = U12 * n.z + U22 * n.y;
  return {(a11 * U11 + a12 * U12) / J, (a21 * U12 + a22 * U22) / J, (a11 * U12 + a12 * U22) / J};
}

}  // namespace gambeson
