#pragma once
/// What a fabric is: numbers of the case, SI.

#include <string>

namespace gambeson {

enum class BendingLaw { linear, zheng };

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

  double surfaceDensity() const { return density_kg_per_m3 * thickness_m; }
};

}  // namespace gambeson
