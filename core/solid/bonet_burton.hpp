#pragma once
/// Transversely isotropic hyperelastic law of yarns (Bonet and Burton, Comput. Methods Appl. Mech. Engrg. 162, 1998;
/// Man 2006, eq. 4.66-4.71). C = FᵀF is the right Cauchy-Green tensor, A the unit direction of the fibres at rest, I1 =
/// tr C, J = sqrt(det C), I4 = A.CA, I5 = A.C²A:
///   psi = mu/2 (I1 - 3) - mu ln J + lambda/2 (J - 1)²                            (4.67)
///       + [alpha + beta ln J + gamma (I4 - 1)] (I4 - 1) - alpha/2 (I5 - 1)       (4.68)   [J/m³]
///   S = mu (1 - C⁻¹) + lambda J (J - 1) C⁻¹ + beta (I4 - 1) C⁻¹
///     + 2 [alpha + beta ln J + 2 gamma (I4 - 1)] A⊗A - alpha (A⊗CA + CA⊗A)       (4.69)   [Pa]
///   D = 2 dS/dC                                                                  (4.70)   [Pa]
/// A_IJKL of eq. 4.71 as printed lacks the symmetry of its last two indices; D here has all of them.
///
/// Valid for det F > 0. Small strains know five moduli, and the five constants are these in another form:
///   D11 = lambda + 2 mu + 8 gamma - 4 alpha + 4 beta,  D12 = lambda + 2 beta,  D22 = lambda + 2 mu,
///   D23 = lambda,  D44 = mu = G_T,  D66 = mu - alpha = G_A   (1 along the fibres).
/// Fails: under compression along the fibres it turns unstable at I4 of about 1/3, as the law of St. Venant and
/// Kirchhoff does, where the fibres are much stiffer than what is between them.

#include <array>

#include "core/math/vec.hpp"

namespace gambeson {

/// A symmetric tensor of second order: 11, 22, 33, 23, 13, 12.
using Symmetric = std::array<double, 6>;
/// A tensor of fourth order with both minor symmetries, a row for each entry of a Symmetric (no factors of 2): the
/// tangent dS = D dE with E's shears counted twice.
using Elasticity = std::array<double, 36>;

struct BonetBurton {
  double lambda_Pa = 0, mu_Pa = 0;
  double alpha_Pa = 0, beta_Pa = 0, gamma_Pa = 0;  ///< 0: isotropic
};

/// What a test at small strain measures. Pulled along the fibres, the material contracts across them by poisson_axial;
/// pulled across them, by poisson_transverse across both. Bonet and Burton take both alike.
struct TransverseModuli {
  double axial_young_Pa = 0, transverse_young_Pa = 0, axial_shear_Pa = 0;
  double poisson_axial = 0, poisson_transverse = 0;
};

struct SolidAnswer {
  double energy_J_per_m3 = 0;
  Symmetric stress_Pa{};  ///< second Piola-Kirchhoff
};

/// Throws InputError where a constant is not finite or small strains could release energy. Allowed:
///   mu > 0,  alpha < mu,  lambda > -mu,
///   gamma > [(lambda + 2 beta)²/(lambda + mu) - lambda - 2 mu + 4 alpha - 4 beta]/8.
void checkLaw(const BonetBurton& law);

/// The law of such moduli. Throws InputError where they are no stable material. Allowed:
///   E_A, E_T, G_A > 0,  -1 < nu_TT < 1,  nu_A² < (E_A/E_T) (1 - nu_TT)/2.
BonetBurton lawOf(const TransverseModuli& moduli);
/// The same numbers back. The law is one that checkLaw accepts.
TransverseModuli moduliOf(const BonetBurton& law);
/// Young's modulus > 0 and -1 < Poisson's ratio < 1/2, the same in all directions. Throws InputError.
BonetBurton isotropicLaw(double young_Pa, double poisson);

/// `fibre` is a unit vector; C is positive definite, else the answer is not a number.
SolidAnswer evaluate(const BonetBurton& law, const Vec3& fibre, const Symmetric& C);
/// The same with the tangent D.
SolidAnswer evaluate(const BonetBurton& law, const Vec3& fibre, const Symmetric& C, Elasticity& D);

}  // namespace gambeson
