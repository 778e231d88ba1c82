#pragma once
/// The human of a case.

#include "cases/wear/case/case.hpp"
#include "human/body/body.hpp"

namespace gambeson {

/// With the skin that the case asks for; `skeletonOf` is quicker and leaves it out (a character has it all the same).
/// `character` tells what was found in a character's file.
Human humanOf(const HumanCase& human, CharacterReport* character = nullptr);
Human skeletonOf(const HumanCase& human, CharacterReport* character = nullptr);

}  // namespace gambeson
