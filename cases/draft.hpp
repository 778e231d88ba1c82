#pragma once
/// The garments of a case, made on its human: what a run sews together, and what `gambeson draft` writes.

#include <iosfwd>

#include "cases/case.hpp"
#include "human/body/body.hpp"

namespace gambeson {

/// With the skin that the case asks for; `skeletonOf` is quicker and leaves it out (a character has it all the same).
/// `character` tells what was found in a character's file.
Human humanOf(const HumanCase& human, CharacterReport* character = nullptr);
Human skeletonOf(const HumanCase& human, CharacterReport* character = nullptr);

/// One garment each, in the case's order, in place (`position`, `weft_angle`), with fabrics and patch names. Those that
/// are drafted lie over those before them. `human` is null where the case has none.
std::vector<Garment> draftGarments(const Case& c, const Human* human);

/// Displacement of every control point from rest at the start: where it is placed, and noise.
std::vector<Vec3> startDisplacements(const Case& c, const std::vector<Garment>& garments);

/// Writes the garment of this name (or the only one) as a file and says on `out` what it is. Throws InputError.
void draftToFile(const Case& c, const std::string& name, const std::filesystem::path& file, std::ostream& out);

}  // namespace gambeson
