#pragma once
/// The law of a cloth as curves: what tensile tests along weft and warp measured, with linear shear and bending.

#include <array>
#include <vector>

#include "core/material/point_energy.hpp"
#include "core/material/table/tension_curve.hpp"

namespace gambeson {

struct CurveLaw {
  std::array<std::vector<TensilePoint>, 2> tension;  ///< weft, warp
  double shear_N_per_m = 0;                          ///< G: n12 over 2 E12
  std::array<double, 3> rigidity_Nm{};               ///< along weft and warp, and of the twist 2 k12
  bool operator==(const CurveLaw&) const = default;
};

/// W(E, k) = W1(E11) + W2(E22) + 1/2 G (2 E12)^2 + 1/2 sum_i B_i k_i^2 [J/m^2], W1 and W2 those of a TensionCurve.
/// Weft and warp know nothing of each other: pulled cloth keeps its width (Poisson's ratio 0), and the strip that a
/// tensile test pulls has the test's force whether its sides are held or free. Shear and bending are linear. It is
/// elastic: no hysteresis. Twist needs no rigidity. Convex where F' > F/(1 + e) along both threads, as in all cloth
/// that stiffens. Pressed together it resists as it does when it is first pulled. Valid between no strain and the last
/// points; beyond them points are counted.
class CurveEnergy : public PointEnergy {
 public:
  /// Throws InputError with the key weft or warp where these are no curve (TensionCurve), or shear, rigidity_weft,
  /// rigidity_warp or twist where G or a rigidity along a thread is not > 0, or a twist not >= 0.
  explicit CurveEnergy(const CurveLaw& law);

  void evaluate(std::span<const SheetStrain> points, SheetParts parts, std::span<const double> history,
                std::span<double> remembered, std::span<SheetAnswer> out) const override;
  /// The greatest slope of each curve in the box, and the others', by themselves: nothing couples them.
  std::array<double, 36> steepest(const StrainBox& within = StrainBox::all()) const override;

  const CurveLaw& law() const { return law_; }
  const TensionCurve& curve(int direction) const { return curves_[static_cast<std::size_t>(direction)]; }

 private:
  CurveLaw law_;
  std::array<TensionCurve, 2> curves_;
};

}  // namespace gambeson
