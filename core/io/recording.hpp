#pragma once
/// The recording of a run: closed HDF5 segments, each written whole and renamed into place, so that a killed writer
/// loses at most the open one; a sidecar (XDMF) that ParaView 5.11 opens, replaced atomically after each segment.

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/io/patch_layout.hpp"
#include "core/io/recorded_table.hpp"

namespace gambeson {

/// Values at the samples or control points of one frame, single precision: data[i * components + c].
struct Field {
  std::string name;
  std::string unit;
  int components = 1;
  std::vector<float> data;
};

struct Frame {
  double time_s = 0;
  std::vector<float> positions;  ///< 3 per sample [m]
  std::vector<Field> sample_fields;
  std::vector<Field> control_fields;  ///< one row per control point, the field "position" (3 components) among them
  /// One row per vertex of a body that deforms, the field "position" among them; empty where none does.
  std::vector<Field> body_fields;
};

/// Values of one name, a list each of numbers, whole numbers and texts.
struct Values {
  std::vector<double> reals;
  std::vector<std::int64_t> integers;
  std::vector<std::string> texts;
};

/// A table with named columns, one row per window of the run, double precision: rows in the order of time.
struct TableRow {
  std::string table;
  std::vector<double> values;
};

/// All state that the next step depends on, by name.
struct Checkpoint {
  double time_s = 0;
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<std::int64_t>> integers;
};

/// What stays constant over a run. `metadata` is free text (JSON) that readers get back; `identity` is what a resumed
/// run must match (the case hash); `scene` holds by name whatever else readers need.
struct RecordingLayout {
  std::string identity;
  std::string metadata;
  std::vector<std::array<int, 3>> triangles;               ///< of samples
  std::map<std::string, std::vector<std::string>> tables;  ///< columns (with units in the names) of each table
  std::vector<std::array<int, 3>> body_triangles{};        ///< of the vertices of a body that deforms, or none
  std::vector<PatchLayout> patches{};
  std::map<std::string, Values> scene{};
};

/// Whether a writer has made a recording in a directory, with or without closed segments.
bool holdsRecording(const std::filesystem::path& directory);

/// What stays constant in the recording of a directory. Throws InputError where there is none, or it is damaged.
RecordingLayout readLayout(const std::filesystem::path& directory);

/// The number of closed segments in a directory; 0 where there is no recording to resume (a run killed before its first
/// checkpoint starts anew).
int closedSegments(const std::filesystem::path& directory);

/// Whether threads may write recordings side by side, each its own: the library below them must have been built so.
bool recordsSideBySide();

/// Frames need ascending times and one row per sample or control point, table rows one value per column: anything else
/// is our own mistake (std::logic_error). Where the file system fails: RunError with the reason.
class RecordingWriter {
 public:
  /// Starts a new recording in `directory` (made if absent). What an earlier recording left there is removed.
  static RecordingWriter create(const std::filesystem::path& directory, const RecordingLayout& layout);
  /// Continues after the last closed segment and returns its checkpoint through `checkpoint`; what an unfinished writer
  /// left behind is removed. Throws InputError where there is no recording, no closed segment, a damaged one, or where
  /// the identity, the triangles or the tables differ. The metadata stay those of the recording.
  static RecordingWriter resume(const std::filesystem::path& directory, const RecordingLayout& layout,
                                Checkpoint& checkpoint);
  RecordingWriter(RecordingWriter&&) noexcept;
  ~RecordingWriter();

  void append(Frame frame);
  void append(TableRow row);
  /// Writes the open segment with this checkpoint: temporary file, fsync, rename, sidecar.
  void closeSegment(const Checkpoint& checkpoint);

 private:
  struct Impl;
  explicit RecordingWriter(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Reads the closed segments of a recording; throws InputError where there is none or a segment is damaged.
class RecordingReader {
 public:
  explicit RecordingReader(const std::filesystem::path& directory);
  RecordingReader(RecordingReader&&) noexcept;
  ~RecordingReader();

  const RecordingLayout& layout() const;
  int frameCount() const;
  double time(int frame) const;
  Frame frame(int index) const;
  /// One of a frame's sample_fields, without the rest of the frame; throws RunError where it has none of that name.
  Field sampleField(int index, const std::string& name) const;
  /// All rows of a table.
  RecordedTable table(const std::string& name) const;
  /// One at the end of each closed segment.
  int checkpointCount() const;
  Checkpoint checkpoint(int index) const;
  Checkpoint lastCheckpoint() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gambeson
