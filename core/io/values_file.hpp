#pragma once
/// Values by name in a file of one run: what it goes on from before its recording begins.

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "core/io/recording.hpp"

namespace gambeson {

/// As own files are written (core/io/own_file.hpp): whole or not at all.
void writeValues(const std::filesystem::path& file, const std::string& identity,
                 const std::map<std::string, Values>& values);

/// Nothing where no such file stands, or one of another identity. Throws InputError where it is damaged.
std::optional<std::map<std::string, Values>> readValues(const std::filesystem::path& file, const std::string& identity);

}  // namespace gambeson
