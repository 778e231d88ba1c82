#pragma once
/// Fractions of a rational arc.

namespace gambeson {

/// The parameter in [0, 1] of a rational quadratic arc at a fraction of its angle, and back; the identity for angle 0.
/// With end weights 1 and the middle weight cos(angle/2) the arc is a stereographic projection:
/// tan(psi/2) = (2 t - 1) tan(angle/4), psi from the middle.
double arcParameter(double angle_rad, double fraction);
double arcFraction(double angle_rad, double t);

}  // namespace gambeson
