#pragma once
/// Tension along a thread as a smooth curve through what was measured.

#include <array>
#include <vector>

namespace gambeson {

/// A point of a tensile test: engineering strain e (extension over length at rest), force per width at rest F [N/m].
using TensilePoint = std::array<double, 2>;

/// What a curve answers at a Green-Lagrange strain E.
struct TensionAnswer {
  double energy_J_per_m2 = 0;    ///< W
  double tension_N_per_m = 0;    ///< n = dW/dE
  double stiffness_N_per_m = 0;  ///< dn/dE
  bool beyond = false;           ///< E lies beyond the last point
};

/// F(e): the cubic in each interval between points (0, 0), (e_1, F_1), ... whose slope at a point between two is the
/// harmonic mean of the secants beside it, weighted as F. N. Fritsch and J. Butland (SIAM J. Sci. Stat. Comput. 5, 300,
/// 1984, eq. 5) do, which lies in the region where F. N. Fritsch and R. E. Carlson (SIAM J. Numer. Anal. 17, 238, 1980)
/// prove the cubic to be monotone: F rises wherever the points do, and F' is continuous. At either end the slope is
/// s^2/m, with s the secant of the last interval and m the slope at its other point, at most 3 s: positive, and that of
/// a straight line on a straight line.
///
///   e = sqrt(1 + 2 E) - 1,   W = integral of F from 0 to e (a quartic, exact),   n = F/(1 + e),
///   dn/dE = (F' - n)/(1 + e)^2.
///
/// Beyond the last point F goes on with the slope that it has there, and below 0 the law is n = F'(0) E, as membranes
/// of a plain fabric are. dn/dE is continuous everywhere.
/// Valid from E > -1/2 to the last point, loading only: what is lost on the way back is not in a curve.
class TensionCurve {
 public:
  /// Throws InputError without key where there is no point, or strains or forces do not ascend strictly from above 0.
  explicit TensionCurve(const std::vector<TensilePoint>& points);

  TensionAnswer at(double E) const;
  /// Force per width at an engineering strain >= 0 [N/m], and the work up to there per area at rest [J/m^2].
  double force(double e) const;
  double work(double e) const;
  /// The engineering strain of a force per width >= 0; that of the last slope where the force lies beyond the points.
  double strainAt(double force_N_per_m) const;
  /// No dn/dE between two strains is greater.
  double steepest(double low, double high) const;
  /// The Green-Lagrange strain of the last point.
  double end() const;

 private:
  struct Knot {
    double e, F, slope, work;  ///< work: of the curve from 0 to here
  };
  const Knot& knotBefore(double e) const;
  std::vector<Knot> knots_;
};

/// Points of the curve that KES-FB1 means by three numbers: the extension EMT at the force F and the linearity
/// LT = WT/(EMT F/2), so that WT = LT EMT F/2 is the work. Of the family of two parameters
///   F(e) = K (exp(b e) - 1)/b
/// (Y. C. Fung, Am. J. Physiol. 213, 1532, 1967: stiffness that grows with the tension, dF/de = K + b F) that one whose
/// curve through 25 points evenly apart has this work (to 1e-12) and ends at (EMT, F). LT 1 is a straight line, LT < 1
/// stiffens, LT > 1 softens. Valid for 0.1 < LT <= 1.5; EMT and F > 0.
std::vector<TensilePoint> tensilePointsOfKes(double extension, double linearity, double force_N_per_m);

}  // namespace gambeson
