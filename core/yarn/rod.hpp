#pragma once
/// A yarn as a rod that stretches, shears, bends and twists, at any rotation (after Simo 1985, Computer Methods in
/// Applied Mechanics and Engineering 49, 55): energy, forces and tangent of the piece between two of its sections.

#include <array>

#include "core/math/vec.hpp"

namespace gambeson {

/// Stiffness of a section. Its axes: along the yarn; across it, in the cloth; through the cloth. A rod without shear is
/// no yarn: where E/G is some hundreds, crimp goes by shear rather than by bending.
struct RodSection {
  double stretch_N = 0;             ///< EA, >= 0
  double shear_across_N = 0;        ///< k GA, of the force across, >= 0
  double shear_through_N = 0;       ///< k GA, of the force through the cloth, >= 0
  double torsion_Nm2 = 0;           ///< GJ, >= 0
  double bending_through_Nm2 = 0;   ///< EI, of curves that leave the cloth (crimp), >= 0
  double bending_in_plane_Nm2 = 0;  ///< EI, of curves in the cloth, >= 0
  bool operator==(const RodSection&) const = default;
};

/// Of an ellipse of half axes a across and b through the cloth [m], E along the yarn and G of its axial shear [Pa]:
///   EA = E pi a b,  EI = E pi a b³/4 and E pi a³ b/4,  GJ = G pi a³ b³/(a² + b²)  (St. Venant),
///   k = 12 (3 c² + d²)/(40 c² + 16 d²),  c the half axis along the force, d the other; 6/7 of a circle
/// (Cowper 1966, Journal of Applied Mechanics 33, 335, at nu = 0: Poisson's ratio enters k with G/E, which is small in
/// a yarn). Throws InputError, keys "yarn.young", "yarn.shear", "yarn.half_width", "yarn.half_thickness", where one is
/// not positive.
RodSection ellipticSection(double young_Pa, double shear_Pa, double half_width_m, double half_thickness_m);

/// A piece between two sections a and b, and its shape without force. Sections are poses: columns of the rotation are
/// the section's axes as above (the first need not be the tangent: the yarn shears), the origin is its middle.
///   Gamma = R_m^T (x_b - x_a)/h,  R_m half way from R_a to R_b,
///   K = log(R_a^T R_b)/h,
///   W = h/2 [EA (|Gamma| - |Gamma_0|)² + (Gamma - Gamma_0) . C_shear (Gamma - Gamma_0) + (K - K_0) . C_K (K - K_0)]
///   [J]
/// Simo stretches along the section's normal. A yarn's fibres run along its middle, however its sections lean: tension
/// belongs to the length of the middle, |Gamma|. So a load T straightens a wave as if its bending and shear were
/// springs in series, 1/P = L²/(pi² B) + 1/GA (Engesser); along the normal it would be 1/(1 - T/GA) in place of 1 +
/// T/GA (Haringx), far off where T is not small against GA, as in yarns. One point for each piece, which is what keeps
/// thin rods from locking; second order in h. K is exact on an arc, so a uniform moment bends and twists any number of
/// pieces alike. Sections of a piece are less than half a turn apart, their middles not at one place.
struct RodPiece {
  double length_m = 0;   ///< h, along the yarn
  Vec3 strain;           ///< Gamma_0: stretch (the share of the length, near 1), shear across, shear through
  Vec3 curvature_per_m;  ///< K_0: twist, bending through the cloth, bending in the cloth
};

/// The piece that these two sections bound without force.
RodPiece restPiece(const Pose& a, const Pose& b, double length_m);

/// What a piece answers. Unknowns are (dx_a, alpha_a, dx_b, alpha_b): x + dx in space [m], R exp(alpha) about the
/// section's own axes [rad].
struct RodAnswer {
  double energy_J = 0;
  double tension_N = 0;  ///< along the middle
  Vec3 force_N;          ///< on the section half way, in its axes: along its normal, across, through the cloth
  Vec3 moment_Nm;        ///< torque, bending through the cloth, bending in the cloth
  std::array<double, 12> gradient{};
  /// The second derivative in these unknowns, symmetric also out of balance; row by row; where it was asked for.
  std::array<double, 144> tangent{};
};
/// downhill: the tangent of a piece that is compressed without what its compression takes from the stiffness across it,
/// for steps downhill from where the tangent itself is far from positive definite.
enum class RodTangent { none, exact, downhill };
RodAnswer evaluateRod(const RodSection& section, const RodPiece& piece, const Pose& a, const Pose& b,
                      RodTangent tangent);

/// R exp(alpha), kept a rotation to rounding.
Mat3 turned(const Mat3& rotation, const Vec3& alpha_rad);

}  // namespace gambeson
