#pragma once
/// How much a run is going to write, said before it fills a disk.

#include <filesystem>
#include <string>

#include "cases/scenario.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

/// Bytes of a recording, about: frames in single precision, tables and checkpoints in double.
struct RecordingSize {
  double frames = 0, windows = 0, checkpoints = 0;  ///< how many
  double bytes = 0;
};
RecordingSize recordingSize(const Scenario& scenario, const RecordingLayout& layout);

/// What is said of so many bytes: more than 10 GB, or than half of what is free. Empty where there is room.
std::string sizeNote(double bytes, double free_bytes);

/// Of the disk that holds the folder; NaN where that cannot be told.
double freeBytes(const std::filesystem::path& folder);

}  // namespace gambeson
