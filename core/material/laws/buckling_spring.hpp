#pragma once
/// A spring that stands for a buckled strip of cloth between its ends (Choi and Ko 2002; Man 2006, eq. 2.3 to 2.10).

#include "core/material/laws/spring.hpp"

namespace gambeson {

/// The angle a in [0, pi] with sin(a)/a = x, of x in [0, 1].
double inverseSinc(double x);

/// A strip of the length L and the bending rigidity k_b [N m^2], pressed to the chord d <= L, is an arc of the same
/// length, of the curvature kappa = (2/L) sinc^-1(d/L) (eq. 2.6). With a = kappa L/2
///   E = k_b L kappa^2/2,   f = k_b kappa^2 (cos a - sinc a)^-1 < 0 along d                    (eq. 2.5 and 2.10).
/// It resists from the start with 12 k_b/L^2 (a pinned Euler column with pi^2 k_b/L^2: an arc is no sine) and jumps to
/// that at d = L. So, as Choi and Ko do, it begins as Hooke's spring of the stiffness c, up to where both are equal:
///   f = -c (L - d) for L - d <= shortest,
/// which is the arc alone for c to infinity, and Hooke's spring alone where c L^3 is below what the arc asks for at any
/// chord. A stretched strip pulls nothing. Valid for 0 < d; at d = 0 the arc is a circle.
class BucklingSpring {
 public:
  BucklingSpring() = default;
  /// k_b > 0 [N m^2], L > 0 [m], c > 0 [N/m].
  BucklingSpring(double rigidity_Nm2, double length_m, double start_N_per_m);

  double rigidity_Nm2() const { return rigidity_; }
  double length_m() const { return length_; }
  /// By how much it is shortened where the arc takes over [m].
  double shortest_m() const { return begins_; }

  /// Energy, force and slope at the squared chord [m^2].
  SpringAnswer<double> answer(double length2) const;

 private:
  double rigidity_ = 0, length_ = 0, start_ = 0;
  double begins_ = 0, offset_J_ = 0;  ///< of the arc's energy, so that both are one there
};

/// f of eq. 2.10 at the half angle a = kappa L/2 [N], at a = 0 its limit -12 k_b/L^2.
double bucklingForce(double rigidity_Nm2, double length_m, double half_angle);

}  // namespace gambeson
