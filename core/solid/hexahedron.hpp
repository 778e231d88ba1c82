#pragma once
/// Hexahedra of eight nodes, trilinear, with 2 x 2 x 2 Gauss points, in the total Lagrangian form: F = sum_a x_a ⊗
/// dN_a/dX, energy = ∫ psi(FᵀF) dV over the volume at rest, force its gradient, stiffness the gradient's slope,
///   f_a = ∫ F S dN_a/dX dV,
///   K_ab = ∫ [Bᵀ_a D B_b + (dN_a/dX . S dN_b/dX) 1] dV   (Man 2006, eq. 2.60-2.63 for solids).
///
/// Corners 0 to 3 go round one face so that its normal by the right hand points to the other face, 4 to 7 round that
/// one, 4 beside 0. Passes the patch test on any shape; bends too stiffly where it is thin (shear) or nearly
/// incompressible.

#include <array>

#include "core/solid/bonet_burton.hpp"

namespace gambeson {

inline constexpr int kHexahedronNodes = 8;

/// A Gauss point at rest.
struct HexahedronPoint {
  std::array<Vec3, kHexahedronNodes> slope_per_m;  ///< dN_a/dX
  double volume_m3 = 0;                            ///< its weight; not positive where the cell is turned inside out
  Vec3 fibre{1, 0, 0};                             ///< unit, at rest
};
using Hexahedron = std::array<HexahedronPoint, 8>;

/// N_a at the point (-1 to 1 in each direction).
std::array<double, kHexahedronNodes> hexahedronShape(const Vec3& local);
/// Where the Gauss points are, in the same coordinates.
const std::array<Vec3, 8>& hexahedronPoints();

/// Of corners at rest [m]. Fibres are left for the caller to set. A cell that is turned inside out at a point has a
/// volume there that is not positive.
Hexahedron hexahedron(const std::array<Vec3, kHexahedronNodes>& rest);

/// The energy [J] at the corners x. `force` [N] is its gradient. Not a number where det F <= 0 at a point.
double evaluate(const Hexahedron& cell, const BonetBurton& law, const std::array<Vec3, kHexahedronNodes>& x,
                std::array<Vec3, kHexahedronNodes>& force);
/// The same with the slope of the force [N/m], 24 x 24 row by row.
double evaluate(const Hexahedron& cell, const BonetBurton& law, const std::array<Vec3, kHexahedronNodes>& x,
                std::array<Vec3, kHexahedronNodes>& force, std::array<double, 576>& stiffness);

/// ∫ N_a N_b dV over the volume at rest [m³], 8 x 8 row by row.
std::array<double, 64> shapeProducts(const Hexahedron& cell);

/// What the law sees at a point: the deformation gradient by columns, C, and det F.
struct PointStrain {
  Mat3 F;
  Symmetric C{};
  double det = 0;
};
PointStrain strainAt(const HexahedronPoint& point, const std::array<Vec3, kHexahedronNodes>& x);

}  // namespace gambeson
