#pragma once
/// The files of a recording and what is in them. Internal to core/io.
///
///     DIR/frames.xdmf                  the sidecar
///     DIR/frames/layout.h5             what stays constant; its presence makes DIR a recording
///     DIR/frames/segment_000000.h5 ... closed segments, numbered from 0 without gaps
///
/// The layout holds  /identity  /metadata  /triangles  /body_triangles  /tables/TABLE (names of columns)
/// /patches/000000/{knots_u, knots_v, weights, curves/000000/{knots, points, weights}}  with the attributes name,
/// degree_u, degree_v of a patch and degree, loop of a curve (a trimming loop's, in the patch's parameters), and
/// /scene/NAME/{reals, integers, texts}, those that are not empty.
///
/// A segment holds  /times  /frames/000000/{positions, vertices, samples/FIELD, controls/FIELD, body/FIELD}  (numbered
/// through; body only where one deforms)
/// /tables/TABLE  /checkpoint/{time, reals/NAME, integers/NAME}.  Names are encoded by hdf5::linkName.

#include "core/error.hpp"
#include "core/io/hdf5_file.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

/// What the sidecar says of a field.
struct FieldInfo {
  std::string name, unit;
  int components = 1;
};

struct FrameInfo {
  double time_s = 0;
  std::size_t samples = 0, controls = 0, body = 0;  ///< rows
  std::vector<FieldInfo> sample_fields, control_fields, body_fields;
};

using TableRows = std::map<std::string, std::vector<std::vector<double>>>;

/// The place of an InputError about a file or directory.
inline InputError::Where at(const std::filesystem::path& path) { return {path.string(), 0, {}}; }

std::filesystem::path layoutPath(const std::filesystem::path& directory);
std::filesystem::path segmentPath(const std::filesystem::path& directory, int index);
/// "000012", the group of a frame, and the path of a field's array within the file.
std::string framePath(int frame);
std::string samplePath(int frame, const std::string& field);
std::string controlPath(int frame, const std::string& field);
std::string bodyPath(int frame, const std::string& field);

std::string layoutImage(const RecordingLayout& layout);
/// What a file of that image says. Throws InputError where it is damaged.
RecordingLayout layoutIn(const std::filesystem::path& file);

/// A segment in the making: appends go to memory, `finish` gives the bytes of the closed file.
class SegmentBuilder {
 public:
  SegmentBuilder(const RecordingLayout& layout, int index, int first_frame);
  /// Throws std::logic_error where sizes disagree; returns what the sidecar needs.
  FrameInfo add(const Frame& frame);
  void add(const TableRow& row);
  std::string finish(const Checkpoint& checkpoint);

 private:
  const RecordingLayout* layout_;
  hdf5::Builder file_;
  int first_frame_;
  std::vector<double> times_;
  std::map<std::string, std::vector<double>> rows_;
};

/// A closed segment. All members throw InputError naming the file where it is damaged or not of this recording.
class SegmentReader {
 public:
  SegmentReader(const std::filesystem::path& directory, const RecordingLayout& layout, int index, int first_frame);
  const std::vector<double>& times() const { return times_; }
  Frame frame(int index) const;  ///< numbered through the recording
  Field sampleField(int index, const std::string& name) const;
  FrameInfo info(int index) const;
  void appendRows(TableRows& rows) const;
  Checkpoint checkpoint() const;

 private:
  std::filesystem::path path_;
  const RecordingLayout* layout_;
  hdf5::File file_;
  int first_frame_;
  std::vector<double> times_;
};

}  // namespace gambeson
