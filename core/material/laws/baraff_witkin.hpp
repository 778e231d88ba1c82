#pragma once
/// The membrane of Baraff and Witkin: threads as springs, and the cosine between them.

#include "core/material/laws/law.hpp"

namespace gambeson {

/// Per width of cloth: stiffnesses [N/m] and coefficients of damping [N s/m], of stretch along weft and warp, and of
/// shear.
template <class P>
struct BaraffWitkinNumbers {
  P weft{}, warp{}, shear{};
  P stretch_damping{}, shear_damping{};
};

/// Baraff and Witkin, Large Steps in Cloth Simulation (Siggraph 1998), as Wong 2014, eq. 3.3 to 3.7 has it. With w_u
/// and w_v the images of the unit vectors of weft and warp, the conditions of a triangle with the area a at rest are
///   C_u = sqrt(a) (|w_u| - 1),  C_v = sqrt(a) (|w_v| - 1),  C_s = sqrt(a) w_u . w_v,   E = 1/2 sum k C^2.
/// Printed is the weight a, not its root: then the energy goes with a^2, and cloth softens as its mesh is refined. Per
/// area, in Green-Lagrange strains e = (E11, E22, 2 E12), |w_u| = l_u = sqrt(1 + 2 e1), w_u . w_v = e3,
///   W = k_u/2 (l_u - 1)^2 + k_v/2 (l_v - 1)^2 + k_s/2 e3^2  [J/m^2],
///   n = dW/de = (k_u (1 - 1/l_u), k_v (1 - 1/l_v), k_s e3)  [N/m],
///   slope = diag(k_u/l_u^3, k_v/l_v^3, k_s).
/// Along a thread the force per width is P = k (l - 1), against E l (l^2 - 1)/2 of St. Venant-Kirchhoff. Stretch along
/// one thread does not pull on the other: nu = 0. k_u = k_v = 2 k_s is isotropic for small strains. This slope is
/// positive; but where threads are pressed (l < 1, n < 0) the tangent of a triangle, which has n times the second
/// derivatives of the strains in it (eq. 3.28), is indefinite. Valid for k > 0, l_u and l_v > 0; l = 0 gives a finite
/// force.
template <unsigned kParts, class S, class P>
GAMBESON_LAW void baraffWitkin(const BaraffWitkinNumbers<P>& law, const S* e, Answer<S, 3>& out) {
  const S u2 = 1.0 + 2.0 * e[0] + 1e-300, v2 = 1.0 + 2.0 * e[1] + 1e-300;
  const S u = 1.0 / root(u2), v = 1.0 / root(v2);
  out.resultant[0] = law.weft * (1.0 - u);
  out.resultant[1] = law.warp * (1.0 - v);
  out.resultant[2] = law.shear * e[2];
  if constexpr (kParts & with_energy) {
    const S longer_u = u2 * u - 1.0, longer_v = v2 * v - 1.0;
    out.energy +=
        0.5 * (law.weft * (longer_u * longer_u) + law.warp * (longer_v * longer_v) + law.shear * (e[2] * e[2]));
  }
  if constexpr (kParts & with_slope) {
    out.slope[0] = law.weft * (u * u * u);
    out.slope[1] = law.warp * (v * v * v);
    out.slope[2] = spread<S>(law.shear);
    out.slope[3] = out.slope[4] = out.slope[5] = S{};
  }
}

/// Damping of the same conditions (Wong 2014, eq. 3.8 with the weight a): f = -k_d dC/dx (dC/dx)T v. Per area, with the
/// rates r of e, dl_u/dt = r1/l_u,
///   n = (k_d r1/l_u^2, k_d r2/l_v^2, k_ds r3)  [N/m],   power n . r >= 0  [W/m^2],
///   slope of n by r = diag(k_d/l_u^2, k_d/l_v^2, k_ds)  (eq. 3.29).
/// Rigid motions have no rate. `energy` becomes the power.
template <unsigned kParts, class S, class P>
GAMBESON_LAW void baraffWitkinDamping(const BaraffWitkinNumbers<P>& law, const S* e, const S* rate, Answer<S, 3>& out) {
  const S u = law.stretch_damping / (1.0 + 2.0 * e[0] + 1e-300), v = law.stretch_damping / (1.0 + 2.0 * e[1] + 1e-300);
  out.resultant[0] = u * rate[0];
  out.resultant[1] = v * rate[1];
  out.resultant[2] = law.shear_damping * rate[2];
  if constexpr (kParts & with_energy)
    out.energy += out.resultant[0] * rate[0] + out.resultant[1] * rate[1] + out.resultant[2] * rate[2];
  if constexpr (kParts & with_slope) {
    out.slope[0] = u;
    out.slope[1] = v;
    out.slope[2] = spread<S>(law.shear_damping);
    out.slope[3] = out.slope[4] = out.slope[5] = S{};
  }
}

}  // namespace gambeson
