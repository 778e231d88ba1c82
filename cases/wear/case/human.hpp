#pragma once
/// The human of a case.

#include <string>
#include <vector>

#include "cases/wear/case/case.hpp"
#include "human/body/body.hpp"

namespace gambeson {

/// What a user should know of a wearer: what bears on the results, and what was found in files and made of measures.
struct WearerNotes {
  std::vector<std::string> notes, facts;
};

/// With the skin that the case asks for; `skeletonOf` is quicker and leaves it out (characters and scans have it all
/// the same). `notes` takes what is found and made. Throws InputError with the case's keys,
/// or with the file of a character or scan.
Human humanOf(const HumanCase& human, WearerNotes* notes = nullptr);
Human skeletonOf(const HumanCase& human, WearerNotes* notes = nullptr);

/// What tables call the wearer: a manikin's name, the stem of a character's or scan's file, or "own".
std::string wearerName(const HumanCase& human);

}  // namespace gambeson
