#include "cases/yarns/design.hpp"

#include "cases/input/wrong_entry.hpp"
#include "core/error.hpp"

namespace gambeson {

Weave weaveOf(const WeaveCase& weave) {
  switch (weave.pattern) {
    case WeavePattern::plain:
      return plainWeave();
    case WeavePattern::twill:
      return twillWeave(weave.over.value_or(2), weave.under.value_or(2));
    case WeavePattern::satin:
      return satinWeave(weave.ends.value_or(5), weave.step.value_or(2));
    case WeavePattern::matrix:
      return weaveOf(weave.matrix);
  }
  return {};
}

RodSection sectionOf(const YarnCase& yarn) {
  if (const auto* section = std::get_if<RodSection>(&yarn.stiffness)) return *section;
  const auto massive = [&](double young_Pa, double shear_Pa) {
    return ellipticSection(young_Pa, shear_Pa, yarn.shape.half_width_m, yarn.shape.half_thickness_m);
  };
  if (const auto* same = std::get_if<IsotropicYarn>(&yarn.stiffness))
    return massive(same->young_Pa, 0.5 * same->young_Pa / (1 + same->poisson));
  const auto& m = std::get<YarnModuli>(yarn.stiffness);
  return massive(m.young_Pa, m.shear_Pa);
}

WovenYarns wovenYarns(const CellDesign& c) {
  return {weaveOf(c.weave), {c.yarn(along_weft).shape, c.yarn(along_warp).shape}};
}

RodFriction rodFriction(const CellDesign& c) {
  if (!c.friction) return {};
  const double touch_m = c.weft.shape.half_thickness_m + c.warp->shape.half_thickness_m;
  const double usual = c.compression ? c.compression->half_force_N / (touch_m * touch_m * touch_m) : 0;
  return {c.friction->coefficient, c.friction->stick_stiffness_N_per_m3.value_or(usual)};
}

RodCellDesign rodDesign(const CellDesign& c) {
  RodCellDesign design;
  design.yarns = wovenYarns(c);
  design.section = {sectionOf(c.yarn(along_weft)), sectionOf(c.yarn(along_warp))};
  design.contact = c.contact;
  if (c.compression) design.compression = *c.compression;
  design.touch = c.by_section ? RodTouch::section : RodTouch::axis;
  design.faces = c.holds_faces ? FaceSupport::held : FaceSupport::glide;
  design.pieces_per_spacing = c.solver.pieces_per_spacing;
  design.extent = c.quarter ? CellExtent::quarter : CellExtent::full;
  if (c.friction) design.friction = rodFriction(c);
  return design;
}

EquilibriumOptions equilibriumOptions(const CellSolver& solver) {
  return {solver.tolerance, solver.iterations, solver.halvings};
}

namespace {

/// Of a yarn; keys of what is wrong are those of its table.
BonetBurton solidLaw(const YarnCase& yarn) {
  if (const auto* same = std::get_if<IsotropicYarn>(&yarn.stiffness))
    return underKey("isotropic", [&] { return isotropicLaw(same->young_Pa, same->poisson); });
  if (std::holds_alternative<RodSection>(yarn.stiffness))
    throw InputError({"", 0, "section"}, "is of a rod; allowed with yarns solid: moduli or isotropic");
  const auto& m = std::get<YarnModuli>(yarn.stiffness);
  const auto required = [](const char* key, const std::optional<double>& value) {
    if (!value) throw InputError({"", 0, std::string("moduli.") + key}, "is required with yarns solid");
    return *value;
  };
  TransverseModuli moduli;
  moduli.axial_young_Pa = m.young_Pa;
  moduli.axial_shear_Pa = m.shear_Pa;
  moduli.transverse_young_Pa = required("transverse_young", m.transverse_young_Pa);
  moduli.poisson_axial = required("poisson_axial", m.poisson_axial);
  moduli.poisson_transverse = m.poisson_transverse.value_or(moduli.poisson_axial);
  return underKey("moduli", [&] { return lawOf(moduli); });
}

}  // namespace

SolidCellDesign solidDesign(const CellDesign& c) {
  SolidCellDesign design;
  design.yarns = wovenYarns(c);
  design.law = {underKey("weft", [&] { return solidLaw(c.yarn(along_weft)); }),
                underKey("warp", [&] { return solidLaw(c.yarn(along_warp)); })};
  const SolidsCase solids = c.solids.value_or(SolidsCase{});
  design.meshing = solids.mesh;
  design.quarter = c.quarter;
  design.faces = c.holds_faces ? FaceSupport::held : FaceSupport::glide;
  design.contact = c.contact;
  if (c.friction) design.friction = c.friction->coefficient;
  design.bound = solids.bound;
  design.penalty = solids.penalty;
  return design;
}

SolidLoadOptions solidOptions(const CellDesign& c) {
  const SolidsCase solids = c.solids.value_or(SolidsCase{});
  SolidLoadOptions o;
  o.method = solids.method;
  o.halvings = c.solver.halvings;
  o.iterations = solids.iterations;
  o.tolerance = c.solver.tolerance;
  o.passes = solids.passes;
  o.change = solids.change;
  o.deepest = solids.deepest;
  return o;
}

KawabataCloth trussOf(const CellDesign& c) {
  KawabataCloth cloth;
  for (const int d : {along_weft, along_warp}) {
    const WovenYarn& own = c.yarn(d).shape;
    cloth.yarn[d] = {c.yarn(1 - d).shape.spacing_m, own.amplitude_m, sectionOf(c.yarn(d)).stretch_N, 1 / own.spacing_m,
                     own.half_thickness_m};
  }
  if (c.compression) cloth.compression = *c.compression;
  return cloth;
}

}  // namespace gambeson
