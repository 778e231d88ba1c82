#pragma once
/// How much room a run takes on a disk, said before it fills it.

#include <filesystem>
#include <string>

namespace gambeson {

/// What is said of so many bytes: more than 10 GB, or than half of what is free. Empty where there is room.
std::string sizeNote(double bytes, double free_bytes);

/// Of the disk that holds the folder; NaN where that cannot be told.
double freeBytes(const std::filesystem::path& folder);

}  // namespace gambeson
