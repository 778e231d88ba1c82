#pragma once
/// Tables for spreadsheets with a decimal comma, beside those that our own readers take.

#include <filesystem>
#include <vector>

namespace gambeson {

/// Folder of a results folder that has them.
inline constexpr const char* kEuropeanTables = "european";

/// Of each table (NAME.csv) that we wrote in the folder, or in a folder within it, the same beside it as
/// european/NAME.csv (core/io/csv_text.hpp); returns what was written. Throws InputError where something that is not
/// ours is in the way, RunError where the file system fails.
std::vector<std::filesystem::path> writeEuropeanTables(const std::filesystem::path& folder);

}  // namespace gambeson
