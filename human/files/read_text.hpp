#pragma once
/// Reading what a user hands in.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace gambeson {

/// The bytes of a regular, non-empty file of at most `max_bytes`. Throws InputError: missing, a folder, unreadable,
/// empty, too large.
std::string readText(const std::filesystem::path& file, std::uintmax_t max_bytes);

/// A finite number that fills `text` but for blanks around it; false where it is anything else (units, "nan", "1e999",
/// "").
bool parseNumber(std::string_view text, double& value);

}  // namespace gambeson
