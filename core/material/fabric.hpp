#pragma once
/// What a fabric is: numbers of the case, SI.

#include <string>
#include <vector>

#include "core/material/section.hpp"

namespace gambeson {

/// linear: m = B kappa, B given; zheng: eq. 2.14; consistent: D = h^2/12 times the membrane's stiffness (a homogeneous
/// St. Venant-Kirchhoff sheet).
enum class BendingLaw { linear, zheng, consistent };

struct Fabric {
  std::string name;
  double thickness_m = 0;
  double density_kg_per_m3 = 0;
  /// Membrane, Zheng 2013, eq. 2.13, plane stress: Young's moduli along weft and warp, in-plane shear modulus,
  /// Poisson's ratio nu_weft_warp (contraction along warp under weft tension).
  double young_weft_Pa = 0, young_warp_Pa = 0, shear_Pa = 0, poisson = 0;
  BendingLaw bending_law = BendingLaw::zheng;
  /// B0 of eq. 2.14 or the linear rigidity, weft and warp [N m].
  double bending_weft_Nm = 0, bending_warp_Nm = 0;
  /// kappa_0 of eq. 2.14 [1/m] and the curvature below which the root is regularised.
  double kappa0_per_m = 0, kappa_regular_per_m = 0;
  /// Twist rigidity [N m]: m_12 = twist * 2 kappa_12 (G h^3/12 for a homogeneous plate); zero in the thesis.
  double twist_Nm = 0;
  /// Rest curvature: false, zero (the thesis); true, that of the rest shape.
  bool rest_curvature_of_shape = false;

  /// A layered section: its membrane and bending stiffness replace all of the above but the density. The thickness is
  /// the sum of the plies.
  std::vector<Ply> plies;
  /// No compression: the membrane's energy is relaxed to its tension field (core/material/tension_field.hpp). Not with
  /// a laminate whose B is not zero.
  bool tension_field = false;
  /// Area ratio J0 below which the membrane jams (core/material/jamming.hpp); 0: never. Not with a tension field.
  double jam_area = 0;

  bool operator==(const Fabric&) const = default;

  /// [m]; a layered section has the thickness of its plies.
  double thickness() const {
    double thickness = plies.empty() ? thickness_m : 0;
    for (const Ply& ply : plies) thickness += ply.thickness_m;
    return thickness;
  }
  /// [kg/m^2]
  double surfaceDensity() const { return density_kg_per_m3 * thickness(); }
};

}  // namespace gambeson
