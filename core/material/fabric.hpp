#pragma once
/// What a fabric is: numbers of the case, SI.

#include <memory>
#include <string>

#include "core/material/laws/bending_laws.hpp"
#include "core/material/laws/shear_friction.hpp"

namespace gambeson {

class PointEnergy;

struct Fabric {
  std::string name;
  double thickness_m = 0;
  double density_kg_per_m3 = 0;
  /// Membrane, Zheng 2013, eq. 2.13, plane stress: Young's moduli along weft and warp, in-plane shear modulus,
  /// Poisson's ratio nu_weft_warp (contraction along warp under weft tension).
  double young_weft_Pa = 0, young_warp_Pa = 0, shear_Pa = 0, poisson = 0;
  /// Between threads that turn against each other, beside the shear modulus.
  ShearFriction shear_friction;
  /// How it bends: one law of BendingLaws with its numbers (core/material/laws). A Laminate also replaces the membrane
  /// above and the thickness.
  BendingLaw law = ZhengBending{};
  /// Rest curvature: false, zero (the thesis); true, that of the rest shape.
  bool rest_curvature_of_shape = false;

  /// No compression: the membrane's energy is relaxed to its tension field (core/material/laws/tension_field.hpp). Not
  /// with a laminate whose B is not zero.
  bool tension_field = false;
  /// Area ratio J0 below which the membrane jams (core/material/laws/jamming.hpp); 0: never. Not with a tension field.
  double jam_area = 0;

  /// Where given, what a point answers (core/material/point_energy.hpp), in place of the membrane, the bending law and
  /// jamming. What else asks for moduli and rigidities has those above, of cloth at rest (linearised). The same fabric
  /// means the same object here. Cloth made of NURBS alone carries it.
  std::shared_ptr<const PointEnergy> energy;

  bool operator==(const Fabric&) const = default;

  const Laminate* laminate() const { return std::get_if<Laminate>(&law); }
  /// [m]; a laminate has the thickness of its plies.
  double thickness() const { return laminate() ? laminate()->thickness_m() : thickness_m; }
  /// [kg/m^2]
  double surfaceDensity() const { return density_kg_per_m3 * thickness(); }
};

}  // namespace gambeson
