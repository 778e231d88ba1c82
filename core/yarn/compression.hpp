#pragma once
/// What presses two crossing yarns together: the law of lateral compression.

#include <cmath>

namespace gambeson {

/// F = P ((D - d)/d)^p [N] for d < D, else 0; d is the distance of the middles of two yarns that cross at right angles,
/// D = b1 + b2 the distance at which they touch. Thus P [N] presses them to half of their thickness, and no force
/// presses them flat, as with the energy C (d0/d)^a of de Jong and Postle (Man 2006, eq. 4.12). Both yarns take part:
/// D - d = (decrease of thickness of yarn 1 + that of yarn 2)/2 = Phi(F) (Man 2006, eqs. 4.5-4.7, after Kawabata).
/// P > 0, p from 2 to 6; above 2 contact between rods has a continuous tangent (yarn_contact.hpp).
struct LateralCompression {
  double half_force_N = 0;  ///< P
  double exponent = 3;      ///< p

  /// Phi(F), how much nearer the middles are under F >= 0 [m].
  double approach_m(double force_N, double touch_m) const {
    const double r = std::pow(force_N / half_force_N, 1 / exponent);
    return touch_m * r / (1 + r);
  }
  double force_N(double distance_m, double touch_m) const {
    return distance_m < touch_m ? half_force_N * std::pow(touch_m / distance_m - 1, exponent) : 0;
  }
};

/// Throws InputError, key "compression.half_force" or "compression.exponent", where a number is out of range.
void checkCompression(const LateralCompression& law);

}  // namespace gambeson
