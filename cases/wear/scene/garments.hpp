#pragma once
/// The garments of a case, made on its human: what a run sews together.

#include "cases/wear/case/case.hpp"
#include "human/body/body.hpp"

namespace gambeson {

/// One garment each, in the case's order, in place (`position`, `weft_angle`), with fabrics and patch names. Those that
/// are drafted lie over those before them. `human` is null where the case has none.
std::vector<Garment> draftGarments(const Case& c, const Human* human);

/// Displacement of every control point from rest at the start: where it is placed, and noise.
std::vector<Vec3> startDisplacements(const Case& c, const std::vector<Garment>& garments);

}  // namespace gambeson
