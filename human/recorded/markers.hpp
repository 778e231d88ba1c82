#pragma once
/// Trajectories of markers: .trc files.

#include <filesystem>
#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// Positions in metres in the file's own axes; NaN where a marker was not seen.
struct MarkerTable {
  std::string file;
  std::vector<std::string> names;
  std::vector<double> times;
  std::vector<std::vector<Vec3>> positions;  ///< of each frame, of each marker
  std::vector<std::string> notes;

  int marker(const std::string& name) const;  ///< -1 where there is none
};

/// Counts in the header are not believed: where they are wrong, a note says so. Units mm, cm, dm or m. Throws
/// InputError with file, line and column.
MarkerTable readTrc(const std::filesystem::path& file);

}  // namespace gambeson
