#pragma once
/// Two rods that touch: energy by the lengths of both.

#include "core/yarn/compression.hpp"

namespace gambeson {

/// Energy per length of one rod and per length of the other of two points of their middles at the distance d, and its
/// derivatives in d.
struct LineContact {
  double energy = 0;  ///< w [J/m²]
  double first = 0;   ///< dw/dd [N/m²]
  double second = 0;  ///< [N/m³]
};

/// The density whose integral over both of two straight rods that cross at right angles at the distance d gives the
/// force F(d) of the law of lateral compression:
///   W = integral of w over ds dt = 2 pi integral from d of w(l) l dl,  F = -dW/dd = 2 pi d w(d)
/// so w(d) = F(d)/(2 pi d). Under an angle phi the force is F/sin(phi): yarns touch along more of their lengths. It
/// sees the thickness of sections and not their width. Zero from d = touch on; d > 0.
LineContact lineContact(const LateralCompression& law, double touch_m, double distance_m);

}  // namespace gambeson
