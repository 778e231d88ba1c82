#pragma once
/// Detail of manikin.hpp and measures.hpp: a manikin from one person's facts.

#include <nlohmann/json.hpp>
#include <string>

#include "human/body/body.hpp"

namespace gambeson {

/// `person` has the keys of a manikin in human/data/manikins.json.
Human manikinOf(const nlohmann::json& person, bool female, const std::string& name);

}  // namespace gambeson
