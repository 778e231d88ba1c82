#pragma once
/// Functions of the three strains of a sheet as tensor products of splines.

#include <array>
#include <span>
#include <vector>

#include "core/material/table/law_table_data.hpp"
#include "core/material/table/spline_axis.hpp"

namespace gambeson {

/// A value and its derivatives in E11, E22, 2 E12; second ones in the order 11, 22, 33, 12, 13, 23.
struct StrainTaylor {
  double value = 0;
  std::array<double, 3> first{};
  std::array<double, 6> second{};
};

/// `kParts` functions side by side.
template <int kParts>
class StrainSpline {
 public:
  /// Zero everywhere.
  StrainSpline();
  /// Through values at the nodes, [node][part] in the grid's order. `parity`: +1 for functions that are even in the
  /// shear, -1 for odd ones, whose nodes are those not below 0; 0: the grid has all nodes.
  StrainSpline(const StrainGrid& grid, std::span<const double> values, const std::array<int, kParts>& parity);

  void evaluate(const std::array<double, 3>& E, std::array<StrainTaylor, kParts>& out) const;

 private:
  std::array<SplineAxis, 3> axes_;
  std::vector<double> coefficients_;  ///< [i][j][k][part]
};

extern template class StrainSpline<1>;
extern template class StrainSpline<3>;
extern template class StrainSpline<6>;

}  // namespace gambeson
