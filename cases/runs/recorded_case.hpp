#pragma once
/// The case of a results folder: DIR/case.json, which its recording holds too.

#include <filesystem>

#include "core/io/recording.hpp"

namespace gambeson {

/// DIR/case.json. Throws InputError where it is missing.
std::filesystem::path caseFile(const std::filesystem::path& dir);

/// Throws InputError where DIR/case.json is not to the letter the case that was recorded in DIR: one of the two is of
/// another run.
void requireRecordedCase(const std::filesystem::path& dir, const RecordingLayout& recorded);

}  // namespace gambeson
