#pragma once
/// A case file with values that the command line puts in their places.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/input/json.hpp"

namespace gambeson {

/// The file with the values of the command line in their places, not yet checked.
JsonNode readCaseNode(const std::filesystem::path& file, const std::vector<std::string>& overrides);

}  // namespace gambeson
