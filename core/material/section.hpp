#pragma once
/// Linear sections: plane-stress plies, classical laminates, and the stiffness that the shell integrates.

#include <array>
#include <span>

namespace gambeson {

/// A symmetric 3 x 3 matrix in Voigt order (11, 22, 12 engineering): 11 22 33 12 13 23.
using Voigt = std::array<double, 6>;

/// n = A e + B k, m = B e + D k with e = (E11, E22, 2 E12), k = changes of (kappa11, kappa22, 2 kappa12) in the sense
/// of Zheng 2013, eq. 2.9, n [N/m], m [N]. A in N/m, B in N, D in N m. Sign of B: kappa = a3 . x,ab, so that a fibre at
/// the height z along the normal a3 stretches by E - z kappa.
struct Section {
  Voigt A{}, B{}, D{};
};

/// One ply, plane stress; axis 1 is its fibre. `angle_rad` turns the fibre from axis 1 of the section (the weft
/// direction of the cloth) towards axis 2, counter-clockwise seen against the normal.
struct Ply {
  double thickness_m = 0;
  double young1_Pa = 0, young2_Pa = 0, shear_Pa = 0, poisson12 = 0;
  double angle_rad = 0;

  bool operator==(const Ply&) const = default;
};

/// Reduced stiffness Q-bar of a ply in the section's axes [Pa] (Jones, Mechanics of Composite Materials, 2nd ed., eq.
/// 2.85). Throws InputError unless moduli are > 0 and poisson12^2 young2 < young1.
Voigt reducedStiffness(const Ply& ply);

/// Classical laminate theory (Jones, eq. 4.22 to 4.24): plies from the bottom (-normal) to the top, the reference
/// surface at half of the total thickness. A single ply gives A = Q h, B = 0, D = Q h^3/12.
Section laminate(std::span<const Ply> plies);

}  // namespace gambeson
