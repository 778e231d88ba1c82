#pragma once
/// A cloth that stiffens, in closed form, and tables of it.

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/material/table/law_table_data.hpp"

namespace gambeson {

/// Wm = p + (p^2)/2 + s (cosh(4 g) - 1), p = a (cosh(c E11) - 1) + a (cosh(c E22) - 1) + h (E11 + E22)^2: convex, even
/// in shear. b and D change with the strain, with the parity of a cloth that a mirror turns weft over.
struct StiffeningCloth {
  double a = 0.5, c = 12, h = 20, s = 5;

  double energy(const std::array<double, 3>& E) const {
    const double sum = E[0] + E[1];
    const double p = a * (std::cosh(c * E[0]) - 1) + a * (std::cosh(c * E[1]) - 1) + h * sum * sum;
    return p + 0.5 * p * p + s * (std::cosh(4 * E[2]) - 1);
  }
  /// n11, n22, n12.
  std::array<double, 3> resultant(const std::array<double, 3>& E) const {
    const double sum = E[0] + E[1];
    const double p = a * (std::cosh(c * E[0]) - 1) + a * (std::cosh(c * E[1]) - 1) + h * sum * sum;
    return {(1 + p) * (a * c * std::sinh(c * E[0]) + 2 * h * sum),
            (1 + p) * (a * c * std::sinh(c * E[1]) + 2 * h * sum), 4 * s * std::sinh(4 * E[2])};
  }
  static std::array<double, 3> moment(const std::array<double, 3>& E) {
    return {1e-3 * std::sin(3 * E[0]), 2e-3 * E[1] * std::cos(2 * E[2]), 1e-3 * std::sin(E[2]) * (1 + E[0])};
  }
  static std::array<double, 6> rigidity(const std::array<double, 3>& E) {
    return {1e-5 * (1 + E[0] * E[0]), 2e-5 * (1 + E[1]),     4e-6 * (1 + E[2] * E[2]),
            3e-6 * std::cos(E[0]),    1e-6 * std::sin(E[2]), -5e-7 * E[2] * (1 + E[1])};
  }
};

inline std::vector<double> evenly(double low, double high, int count) {
  std::vector<double> out;
  for (int k = 0; k < count; ++k) out.push_back(k + 1 == count ? high : low + (high - low) * k / (count - 1));
  return out;
}

template <class F>
void forEachNode(const StrainGrid& grid, F&& f) {
  for (double e11 : grid.nodes[0])
    for (double e22 : grid.nodes[1])
      for (double g12 : grid.nodes[2]) f(std::array{e11, e22, g12});
}

/// E11, E22 in [-0.02, 0.10], 2 E12 in [0, 0.5], with the mirror, or [-0.5, 0.5]. Nodes are not at equal distances.
inline LawTableData tableOf(const StiffeningCloth& cloth, int extensions, int shears, bool even = true) {
  LawTableData data;
  data.even_in_shear = even;
  data.membrane.nodes = {evenly(-0.02, 0.10, extensions), evenly(-0.02, 0.10, extensions + 1),
                         even ? evenly(0, 0.5, shears) : evenly(-0.5, 0.5, 2 * shears)};
  for (std::size_t i = 1; i + 1 < data.membrane.nodes[0].size(); i += 2) data.membrane.nodes[0][i] += 1e-3;
  data.bending.nodes = {evenly(-0.02, 0.10, 4), evenly(-0.02, 0.10, 3),
                        even ? evenly(0, 0.5, 3) : evenly(-0.5, 0.5, 5)};
  forEachNode(data.membrane, [&](const std::array<double, 3>& E) { data.energy.push_back(cloth.energy(E)); });
  forEachNode(data.bending, [&](const std::array<double, 3>& E) {
    data.moment.push_back(StiffeningCloth::moment(E));
    data.rigidity.push_back(StiffeningCloth::rigidity(E));
  });
  return data;
}

/// n = A e of linear cloth and D k, which tables repeat to rounding; A and D are diagonal but for A12 = a12, D12 = d12.
inline LawTableData linearTable(const std::array<double, 3>& A, double a12, const std::array<double, 3>& D,
                                double d12) {
  LawTableData data;
  data.even_in_shear = true;
  data.membrane.nodes = {evenly(-0.2, 0.3, 5), evenly(-0.2, 0.3, 5), evenly(0, 0.5, 4)};
  forEachNode(data.membrane, [&](const std::array<double, 3>& E) {
    data.energy.push_back(0.5 * (A[0] * E[0] * E[0] + A[1] * E[1] * E[1] + A[2] * E[2] * E[2]) + a12 * E[0] * E[1]);
  });
  data.bending.nodes = {std::vector{0.0}, std::vector{0.0}, std::vector{0.0}};
  data.rigidity = {{D[0], D[1], D[2], d12, 0, 0}};
  return data;
}

}  // namespace gambeson
