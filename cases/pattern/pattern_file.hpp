#pragma once
/// Flat patterns as files that a designer can edit (JSON): what `gambeson import` writes of foreign patterns. Numbers
/// are SI or texts with units; the fields are those of schema::patternTable (cases/FIELDS.md, "Patterns").
///
///   {"format": "gambeson pattern 1", "name": "shirt",
///    "panels": [{"name": "front", "outline": [{"start": [0, 0]},
///                                             {"start": [0.3, 0], "bezier": [[0.35, 0.2]]}, ...], ...}, ...],
///    "seams": [{"name": "s1", "a": ["front.1"], "b": ["back.3 reversed"]}, ...]}

#include <filesystem>
#include <string>

#include "cases/input/schema.hpp"
#include "tryon/pattern/flat/panel.hpp"

namespace gambeson {

/// Reads and checks (checkPattern). Throws InputError with file, line and key.
FlatPattern readPattern(const std::filesystem::path& file);
/// The same of JSON that was parsed.
FlatPattern readPattern(const JsonNode& root, const std::string& file);
/// Whether JSON says that it is such a file.
bool isPattern(const JsonNode& root);

/// What such a file has.
JsonNode patternNode(const FlatPattern& pattern);
/// Text of a file that is read back to the bit.
std::string patternText(const FlatPattern& pattern);

/// How large such a file may be.
inline constexpr std::size_t kPatternBytes = 32u << 20;

namespace schema {
const Object& patternTable();
}  // namespace schema

}  // namespace gambeson
