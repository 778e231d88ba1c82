#pragma once
/// The membrane of cloth.

#include "core/material/laws/linear.hpp"

namespace gambeson {

/// Orthotropic plane stress: the stiffness A [N/m] (order of Voigt) of a sheet of thickness h [m] with Young's moduli
/// along weft and warp, shear modulus [Pa], and Poisson's ratio nu (contraction along the warp under weft tension),
///   A11 = E1 h/s, A22 = E2 h/s, A12 = nu E2 h/s, A33 = G h, s = 1 - nu^2 E2/E1,
/// d1, d2, d3, d4 of Zheng 2013, eq. 2.13, times h. Valid for E1, E2, G > 0 and nu^2 E2 < E1: positive definite only
/// so. h = 1 gives the reduced stiffness of a ply [Pa] (Jones, Mechanics of Composite Materials, 2nd ed., 2.4).
template <class S>
GAMBESON_LAW void planeStress(const S& young1, const S& young2, const S& shear, const S& poisson, const S& thickness,
                              S* A) {
  const S nu21 = poisson * young2 / young1, scale = thickness / (1.0 - poisson * nu21);
  A[0] = young1 * scale;
  A[1] = young2 * scale;
  A[2] = shear * thickness;
  A[3] = poisson * (young2 * scale);
  A[4] = A[5] = S{};
}

/// St. Venant-Kirchhoff (Zheng 2013, eq. 2.13, integrated over the thickness): with Green-Lagrange strains
/// e = (E11, E22, 2 E12) along weft and warp, second Piola-Kirchhoff resultants n = A e [N/m], W = e . A e / 2. For
/// strains of cloth, below 2 % (2.2.2); under compression along one direction it gives way below a stretch of 0.58
/// (core/material/laws/jamming.hpp). `A`: six entries in the order of Voigt, or an OrthotropicStiffness.
template <unsigned kParts, class S, class Stiffness>
GAMBESON_LAW void stVenantKirchhoff(const Stiffness& A, const S* e, Answer<S, 3>& out) {
  linearLaw<kParts>(A, e, out);
}

}  // namespace gambeson
