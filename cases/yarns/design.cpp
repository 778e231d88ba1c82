#include "cases/yarns/design.hpp"

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
  const auto& m = std::get<YarnModuli>(yarn.stiffness);
  return ellipticSection(m.young_Pa, m.shear_Pa, yarn.shape.half_width_m, yarn.shape.half_thickness_m);
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
  design.faces = c.holds_faces ? FaceSupport::held : FaceSupport::glide;
  design.pieces_per_spacing = c.solver.pieces_per_spacing;
  design.extent = c.quarter ? CellExtent::quarter : CellExtent::full;
  if (c.friction) design.friction = rodFriction(c);
  return design;
}

EquilibriumOptions equilibriumOptions(const CellSolver& solver) {
  return {solver.tolerance, solver.iterations, solver.halvings};
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
