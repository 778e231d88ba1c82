#pragma once
/// Numbers that a file may have but textiles have not: a fabric 12 mm thick, a density that was a mass per area.

#include <filesystem>
#include <string>
#include <vector>

#include "cases/input/schema.hpp"
#include "core/error.hpp"

namespace gambeson {

/// A warning for each number of a file beyond what is usual: where it stands, what it is and which range is usual, in
/// the unit that was typed. `object` is the table of `entry`. What cannot be read is passed over.
std::vector<InputError> unusualNumbers(const schema::Object& object, const schema::Entry& entry);
/// The same of a case's fields, in SI: what it says, whatever its file said. `written`: as the table writes it.
std::vector<std::string> unusualNumbers(const schema::Object& object, const JsonNode& written);
/// The same of a card that was read without errors.
std::vector<InputError> unusualOfCard(const std::filesystem::path& card);

/// A note for each fabric of a case (as its table writes it) whose thickness nobody gave.
std::vector<std::string> assumedThicknesses(const JsonNode& written);

}  // namespace gambeson
