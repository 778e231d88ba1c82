#pragma once
/// The law of a cloth as a table.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/material/point_energy.hpp"
#include "core/material/table/law_table_data.hpp"
#include "core/material/table/strain_spline.hpp"

namespace gambeson {

/// W(E, k) = Wm(c(E)) + sum_i g_i(E_i) + k . b(c(E)) + 1/2 k . D(c(E)) . k [J/m^2], with Wm, b and D tensor products of
/// cubic splines in E = (E11, E22, 2 E12), twice continuously differentiable, through the values at the nodes
/// (not-a-knot ends). Resultants, moments and slopes are its exact derivatives.
///
/// Within the range c_i(E_i) = E_i and g_i = 0. At a distance d beyond an end of direction i
///   c_i = end +- m_i (1 - exp(-d/m_i)),   g_i = N_i (d - m_i (1 - exp(-d/m_i))) + 1/2 K_i d^2,
/// where the margin m_i is at most a grid interval, N_i the greatest |dWm/dE_i| [N/m] and K_i the greatest d2Wm/dE_i^2
/// at nodes and margins. W stays continuously differentiable; its second derivatives jump at the end of the range,
/// upwards. Without curvature it is convex beyond where the splines are: with a = c',
///   d2W/dE_i dE_j = a_i a_j d2Wm/dE_i dE_j + delta_ij ((N_i -+ dWm/dE_i) exp(-d/m_i)/m_i + K_i),
/// a sum of what is convex at c(E) and of what is not negative. Margins are halved until the splines are convex there
/// as they are at the end of the range beside it. Forces go over to N_i + K_i d: cloth beyond the range is at least as
/// stiff as any of it.
///
/// Valid: strains of a plane (1 + 2 E positive definite) within the range; curvatures small enough that the energy is
/// quadratic in them. A flag says where a point is beyond the range. No friction: an energy has none.
class LawTable : public PointEnergy {
 public:
  /// Throws InputError as checkLawTable.
  explicit LawTable(const LawTableData& data);

  void evaluate(std::span<const SheetStrain> points, SheetParts parts, std::span<const double> history,
                std::span<double> remembered, std::span<SheetAnswer> out) const override;
  /// alpha diag(S): S the greatest of each diagonal entry at nodes and margins, alpha the greatest eigenvalue of the
  /// slopes there in units of S. Without curvature; what b and D change with E is left out.
  std::array<double, 36> steepest() const override { return steepest_; }

  const LawTableData& data() const { return data_; }
  /// Ends of the range of E11, E22, 2 E12.
  std::array<std::array<double, 2>, 3> range() const;
  /// Whether the splines are convex at all nodes.
  bool convex() const { return convex_; }

 private:
  struct Continued;
  struct Beyond {
    double low = 0, high = 0, margin = 0, force = 0, stiffness = 0;
  };
  Continued continued(int direction, double strain) const;
  void settleMargins();
  void settleSteepest();

  LawTableData data_;
  StrainSpline<1> membrane_;
  StrainSpline<3> moment_;
  StrainSpline<6> rigidity_;
  std::array<Beyond, 3> beyond_;
  std::array<double, 36> steepest_{};
  bool convex_ = true, bends_twice_ = false;
};

}  // namespace gambeson
