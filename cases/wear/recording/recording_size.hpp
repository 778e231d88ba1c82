#pragma once
/// How much a run is going to write, said before it fills a disk.

#include <filesystem>
#include <string>

#include "cases/wear/scene/scenario.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

/// Bytes of a recording, about: frames in single precision, tables and checkpoints in double.
struct RecordingSize {
  double frames = 0, windows = 0, checkpoints = 0;  ///< how many
  double bytes = 0;
};
RecordingSize recordingSize(const Scenario& scenario, const RecordingLayout& layout);

}  // namespace gambeson
