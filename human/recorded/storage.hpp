#pragma once
/// Tables of OpenSim: .mot and .sto files.

#include <filesystem>
#include <string>
#include <vector>

namespace gambeson {

/// Values of each column but time, as the file has them: rotations in degrees or radians, lengths in metres.
struct StorageTable {
  std::string file;
  std::vector<std::string> names;
  std::vector<double> times;
  std::vector<std::vector<double>> columns;
  std::vector<int> lines;  ///< of each row, for messages
  bool in_degrees = false;
  std::vector<std::string> notes;  ///< where the header disagrees with the table

  int column(const std::string& name) const;  ///< -1 where there is none
};

/// Header lines "key=value" or sentences up to "endheader", a line of labels that starts with "time", rows in ascending
/// time. The header must say degrees or radians: inDegrees=yes|no, or "Angles are in degrees." (SIMM). Counts in the
/// header are not believed: where they are wrong, a note says so. Throws InputError with file, line and column.
StorageTable readStorage(const std::filesystem::path& file);

}  // namespace gambeson
