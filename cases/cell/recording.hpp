#pragma once
/// What a run of a cell leaves in its recording, and what readers find there. One closed segment for the cell at rest,
/// and one for each load, in the order of the case: a run goes on after the last of them.

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cases/cell/walk.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

/// Columns of curves.csv beside the name of the load; those of solids come last.
std::vector<std::string> curveColumns(const CellCase& c);

class CellRecorder {
 public:
  /// Begins a recording in a folder, or with `resume` goes on after its last closed segment.
  CellRecorder(const CellCase& c, const CellEngine& engine, const std::filesystem::path& out, bool resume);
  /// Units that are recorded: 0, 1 with the cell at rest, and one more for each load.
  int units() const { return units_; }
  /// The next unit.
  void add(const RestStiffness& rest);
  void add(const WalkedPath& path);

 private:
  void keep(const YarnShape& shape, double row);
  void close(const std::map<std::string, std::vector<double>>& reals,
             const std::map<std::string, std::vector<std::int64_t>>& integers);

  const CellCase& c_;
  const CellEngine& engine_;
  std::optional<RecordingWriter> writer_;
  int units_ = 0, frames_ = 0, rows_ = 0;
};

/// A load as it was recorded.
struct RecordedPath {
  RecordedTable rows;
  bool reached = true;
  std::string why;
  std::optional<int> last_frame;  ///< of its last row; none where it was not reached and not all shapes are kept
};

/// A results folder. Throws InputError where it holds no such run, or is damaged.
class RecordedCell {
 public:
  explicit RecordedCell(const std::filesystem::path& results);

  const CellCase& definition() const { return c_; }
  /// Whether all loads were walked, and to their ends.
  bool whole() const;
  const RestStiffness& rest() const { return rest_; }
  /// As far as they are recorded.
  const std::vector<RecordedPath>& paths() const { return paths_; }
  /// The load of the cell in a frame.
  CellLoad loadOf(const Frame& frame) const;
  const RecordingReader& reader() const { return reader_; }

 private:
  CellCase c_;
  RecordingReader reader_;
  RecordedTable curves_;
  RestStiffness rest_;
  std::vector<RecordedPath> paths_;
};

}  // namespace gambeson
