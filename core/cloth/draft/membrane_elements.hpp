#pragma once
/// What the membrane of cloth of triangles is made of.

namespace gambeson {

/// continuum: the fabric's own membrane, St. Venant-Kirchhoff, in every triangle. springs: one along each edge (Wong
/// 2014, eq. 3.1). baraff_witkin: conditions of stretch along weft and warp and of shear in every triangle (eq. 3.3 to
/// 3.7).
enum class MembraneElements { continuum, springs, baraff_witkin };

/// With what numbers; 0: from the fabric, for stiffnesses. Those of other elements have no meaning.
struct MembraneModel {
  MembraneElements elements = MembraneElements::continuum;
  double spring_N_per_m = 0;                                     ///< of an edge between two triangles, half at a border
  double weft_N_per_m = 0, warp_N_per_m = 0, shear_N_per_m = 0;  ///< per width, of baraff_witkin
  double stretch_damping_Ns_per_m = 0;  ///< of a spring as its stiffness is; of both threads per width
  double shear_damping_Ns_per_m = 0;    ///< per width, of baraff_witkin

  bool operator==(const MembraneModel&) const = default;
};

}  // namespace gambeson
