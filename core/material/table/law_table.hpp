#pragma once
/// The law of a cloth as a table.

#include <array>
#include <initializer_list>
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
/// Within the range c_i(E_i) = E_i and g_i = 0. At a distance d beyond an end of direction i, with a = exp(-d/m_i),
///   c_i = end +- m_i (1 - a),   g_i = (N_i - K_i m_i) (d - m_i (1 - a)) + 1/2 K_i d^2,
/// where the margin m_i is at most a quarter of the range, N_i >= 0 the greatest outward force +- dWm/dE_i [N/m] and
/// K_i >= 0 the greatest d2Wm/dE_i^2 [N/m] beside that end, at nodes and within the margins. W stays continuously
/// differentiable; its second derivatives jump at the end of the range, upwards. Without curvature it is convex beyond
/// the range where the splines are:
///   d2W/dE_i dE_j = a_i a_j d2Wm/dE_i dE_j + delta_ij ((N_i -+ dWm/dE_i) a_i/m_i + K_i (1 - a_i)),
/// a sum of what is convex at c(E) and of what is not negative. Margins are halved until the splines are convex there
/// as they are at the end of the range beside it. Forces go over to N_i + K_i d: far beyond the range cloth is as stiff
/// as anywhere beside its end.
///
/// Valid: strains of a plane (1 + 2 E positive definite) within the range; curvatures small enough that the energy is
/// quadratic in them. A flag says where a point is beyond the range. No friction: an energy has none.
class LawTable : public PointEnergy {
 public:
  /// Throws InputError as checkLawTable.
  explicit LawTable(const LawTableData& data);

  void evaluate(std::span<const SheetStrain> points, SheetParts parts, std::span<const double> history,
                std::span<double> remembered, std::span<SheetAnswer> out) const override;
  /// Of all strains: alpha diag(S), S the greatest of each diagonal entry of the slopes at nodes and beyond the ends,
  /// alpha the greatest eigenvalue of these slopes in units of S. Within a box: of strain the greatest sums of rows, in
  /// these units, at the nodes and half way between them that enclose it; of curvature as of all strains, with what
  /// couples it with strain. Of cloth without curvature.
  std::array<double, 36> steepest(const StrainBox& within = StrainBox::all()) const override;

  const LawTableData& data() const { return data_; }
  /// Ends of the range of E11, E22, 2 E12.
  std::array<std::array<double, 2>, 3> range() const;
  /// Whether Wm is convex at all nodes and within the margins.
  bool convex() const { return convex_; }

 private:
  /// c_i and g_i with their derivatives.
  struct Continued {
    double at = 0, at1 = 1, at2 = 0, energy = 0, energy1 = 0, energy2 = 0;
    bool beyond = false;
  };
  /// One end of a direction: m_i, N_i and K_i.
  struct End {
    double at = 0, margin = 0, force = 0, stiffness = 0;
  };
  using Ends = std::array<End, 2>;
  static Continued continued(const Ends& ends, double strain);
  SheetAnswer answer(const SheetStrain& point, SheetParts parts) const;
  /// Nodes of a direction and places beyond its ends, in margins; on both sides of 0 where even.
  std::vector<double> places(int direction, std::initializer_list<double> margins) const;
  void settleMargins();
  void settleEnds();
  void settleSteepest();
  void settleRows();

  LawTableData data_;
  StrainSpline<1> membrane_;
  StrainSpline<3> moment_;
  StrainSpline<6> rigidity_;
  std::array<Ends, 3> ends_;
  std::array<double, 36> steepest_{};
  std::array<std::vector<double>, 3> looked_;  ///< places of each direction, ascending; of shear where even: from 0 on
  std::vector<std::array<double, 6>> rows_;    ///< sums of rows of the slopes there, e11 slowest
  bool convex_ = true;
};

}  // namespace gambeson
