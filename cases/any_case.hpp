#pragma once
/// A case file of any kind: the one place that looks at "kind".

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "cases/case.hpp"
#include "cases/json.hpp"
#include "cases/structure_case.hpp"

namespace gambeson {

using AnyCase = std::variant<Case, StructureCase>;

/// Reads and checks a case file of the kind that it says it is; as readCase.
AnyCase readAnyCase(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same from a file already read, with values put in their places.
AnyCase readAnyCase(const JsonNode& root, const std::filesystem::path& file);
Case readCase(const JsonNode& root, const std::filesystem::path& file);
StructureCase readStructureCase(const JsonNode& root, const std::filesystem::path& file);

/// The file with the values of the command line in their places, not yet checked.
JsonNode readCaseNode(const std::filesystem::path& file, const std::vector<std::string>& overrides);

/// JSON Schema and documentation of all kinds.
std::string caseSchema();
std::string caseFields();

}  // namespace gambeson
