#include "cases/wear/case/factors.hpp"

#include <fmt/format.h>

#include <cassert>
#include <variant>

namespace gambeson {
namespace {

/// The factor on the springs along seams, as on the bending rigidities.
double bendingScale(const FactorsCase& f) { return f.thickness * f.thickness * f.thickness * f.bending; }

void scale(Fabric& fabric, const FactorsCase& f) {
  const double t = f.thickness;
  fabric.thickness_m *= t;
  fabric.density_kg_per_m3 *= f.inertia;
  fabric.young_weft_Pa *= f.membrane;
  fabric.young_warp_Pa *= f.membrane;
  fabric.shear_Pa *= f.membrane;
  fabric.shear_friction.rise_N_per_m *= t * f.membrane;
  fabric.shear_friction.growth_N_per_m *= t * f.membrane;
  std::visit(
      [&]<class L>(L& law) {
        law.thicken(t);
        if constexpr (L::is_solid)
          assert(false);  // solids are fabrics of structures
        else
          law.stiffen(f.bending);
      },
      fabric.law);
}

/// All that resists sliding.
void scale(FrictionLaw& law, double friction) {
  law.kinetic *= friction;
  law.still *= friction;
  law.viscosity *= friction;
}
void scale(std::optional<FrictionLaw>& law, double friction) {
  if (law) scale(*law, friction);
}

/// What a case gives in the place of the fabric's.
void scale(MembraneModel& m, const FactorsCase& f) {
  for (double* stiffness : {&m.spring_N_per_m, &m.weft_N_per_m, &m.warp_N_per_m, &m.shear_N_per_m})
    *stiffness *= f.membrane * f.thickness;
  for (double* damping : {&m.stretch_damping_Ns_per_m, &m.shear_damping_Ns_per_m}) *damping *= f.thickness;
}

}  // namespace

Case withFactors(const Case& c) {
  Case out = c;
  const FactorsCase& f = c.factors;
  scale(out.fabric, f);
  for (GarmentCase& g : out.garments) {
    if (g.fabric) scale(*g.fabric, f);
    scale(g.cloth.membrane, f);
    for (Fabric& other : g.other_fabrics) scale(other, f);
    scale(g.friction, f.friction);
  }
  for (ObstacleCase& o : out.obstacles) scale(o.friction, f.friction);
  scale(out.contact.friction, f.friction);
  scale(out.contact.friction_cloth, f.friction);
  if (out.contact.layer_m) *out.contact.layer_m *= f.thickness;
  out.gravity_m_per_s2 = (f.weight / f.inertia) * out.gravity_m_per_s2;
  out.air.drag_kg_per_m2s *= f.drag;
  out.factors = {};
  return out;
}

void scaleSeams(Garment& garment, const FactorsCase& f) {
  for (Seam& s : garment.seams) s.stiffness_N *= bendingScale(f);
  for (WeakSeam& s : garment.weak_seams) s.stiffness_N *= bendingScale(f);
  for (SewnSeam& s : garment.sewn_seams) s.stiffness_N *= bendingScale(f);
}

std::string factorsText(const FactorsCase& f) {
  std::string s;
  for (const auto& [name, value] :
       {std::pair("thickness", f.thickness), std::pair("bending", f.bending), std::pair("membrane", f.membrane),
        std::pair("weight", f.weight), std::pair("inertia", f.inertia), std::pair("drag", f.drag),
        std::pair("friction", f.friction)})
    if (value != 1) s += fmt::format("{}{} x {}", s.empty() ? "" : ", ", name, value);
  return s;
}

}  // namespace gambeson
