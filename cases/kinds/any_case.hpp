#pragma once
/// A case file of any kind: the one place that looks at "kind".

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "cases/cell/case.hpp"
#include "cases/input/schema.hpp"
#include "cases/structure/case.hpp"
#include "cases/wear/case/case.hpp"

namespace gambeson {

using AnyCase = std::variant<Case, StructureCase, CellCase>;

/// Reads and checks a case file of the kind that it says it is; as readCase.
AnyCase readAnyCase(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});

/// The same from a file already read, with values put in their places.
AnyCase readAnyCase(const JsonNode& root, const std::filesystem::path& file);

/// The case file and every file that it names, as far as there are such.
std::vector<std::filesystem::path> inputsOf(const AnyCase& c);

/// The kinds by name, each with its field table; the first is that of files without the key "kind".
std::vector<schema::KindOfFile> kindsOfCase();

}  // namespace gambeson
