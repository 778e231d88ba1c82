#pragma once
/// A spring between two points, and what damps it.

#include "core/material/laws/law.hpp"

namespace gambeson {

/// What a spring answers to the distance of its points. A law sets what was asked; what was not stays as it was.
template <class S>
struct SpringAnswer {
  S energy{};      ///< [J]
  S per_length{};  ///< tension over the distance [N/m]: the force on point i is per_length (x_j - x_i), on j minus that
  /// Slope of the force on i by x_j [N/m]: along u uT + across (1 - u uT), u the unit vector from i to j.
  S along{}, across{};
};

/// Below it two points have no direction: their spring pulls nowhere, and nothing divides by zero [m^2].
inline constexpr double spring_least_m2 = 1e-300;

/// Hooke's spring (Wong 2014, eq. 3.1 and 3.26; Man 2006, 2.2). With l the distance and l0 > 0 the rest length [m], and
/// k > 0 the stiffness [N/m],
///   E = k/2 (l - l0)^2,   f_i = k (1 - l0/l) (x_j - x_i) = -f_j,
///   d f_i / d x_j = k u uT + k (1 - l0/l) (1 - u uT).
/// Under compression the slope across is negative: the tangent of a pressed spring is indefinite. Valid for l > 0; the
/// force has no limit where two points meet. `length2`: l^2 [m^2].
template <unsigned kParts, class S, class P>
GAMBESON_LAW SpringAnswer<S> linearSpring(const P& stiffness, const P& rest, const S& length2) {
  const S inverse = 1.0 / root(length2 + spring_least_m2), stretch = 1.0 - rest * inverse;
  SpringAnswer<S> out;
  out.per_length = stiffness * stretch;
  if constexpr (kParts & with_energy) {
    const S longer = length2 * inverse - rest;
    out.energy = 0.5 * stiffness * (longer * longer);
  }
  if constexpr (kParts & with_slope) {
    out.along = spread<S>(stiffness);
    out.across = out.per_length;
  }
  return out;
}

/// Damping of a spring (Wong 2014, eq. 3.2, with the relative velocity w = v_j - v_i projected on the unit vector u, as
/// momentum asks): with c >= 0 the coefficient [N s/m],
///   f_i = c (u . w) u = -f_j,   power taken from the points c (u . w)^2 >= 0 [W],
///   d f_i / d v_j = c u uT (eq. 3.27, which prints the unit matrix in its place).
/// A turning spring loses nothing. Returns the force over the distance, f_i = that times (x_j - x_i) [N/m]; that times
/// (x_j - x_i) . w is the power, and the slope is c/l^2 (x_j - x_i)(x_j - x_i)T. `along`: (x_j - x_i) . w [m^2/s].
template <class S, class P>
GAMBESON_LAW S springDamping(const P& coefficient, const S& length2, const S& along) {
  return coefficient * along / (length2 + spring_least_m2);
}

}  // namespace gambeson
