#pragma once
/// The garments of a case, made on its human: what a run sews together.

#include <optional>
#include <vector>

#include "cases/wear/case/case.hpp"
#include "cases/wear/case/garments/kind.hpp"
#include "core/cloth/draft/mesh_draft.hpp"
#include "human/body/body.hpp"
#include "human/motion/motion.hpp"

namespace gambeson {

/// One garment each, in the case's order, in place (`position`, `weft_angle`), with fabrics and patch names. Those that
/// are drafted lie over those before them. `human` is null where the case has none. `fits`: takes how each of them
/// fits.
std::vector<Garment> draftGarments(const Case& c, const Human* human, std::vector<GarmentFit>* fits = nullptr);
/// Whether the human is dressed with the arms further from the sides than they hang: panels are sewn around trunk or
/// arms, none of the garments is drafted for hanging arms, and there is time for them to come down again.
bool armsAside(const Case& c);
/// In which posture all garments of a case are drafted and put on.
Posture dressingPosture(const Case& c, const Human& human);
/// In which one of them is: as dressingPosture, but for panels that were placed around the wearer as he was scanned.
Posture puttingOnPosture(const Case& c, const GarmentCase& worn, const Human& human);
/// Gives a garment the fabrics and fields that the case says of it.
void addFabric(const Case& c, const GarmentCase& worn, Garment& garment);
/// Of each garment that is a mesh from the start its triangles; `drafts`: of the same garments. Throws InputError with
/// the garment's key.
std::vector<std::optional<MeshDraft>> readMeshes(const Case& c, const std::vector<Garment>& drafts);

/// Displacement of every control point from rest at the start: where it is placed, and noise.
std::vector<Vec3> startDisplacements(const Case& c, const std::vector<Garment>& garments);

}  // namespace gambeson
