#include "core/io/recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/error.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/own_file.hpp"
#include "core/io/segment.hpp"
#include "core/io/segment_name.hpp"
#include "core/io/xdmf.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

fs::path sidecarPath(const fs::path& directory) { return directory / "frames.xdmf"; }

/// Removes the files of `directory` that `ours` picks by name.
template <class Pick>
void removeFiles(const fs::path& directory, Pick ours) {
  std::vector<fs::path> doomed;
  for (const auto& entry : fs::directory_iterator(directory))
    if (ours(entry.path().filename().string())) doomed.push_back(entry.path());
  for (const auto& path : doomed) fs::remove(path);
}

void removeUnfinished(const fs::path& directory) {
  const std::string suffix(kUnfinishedSuffix);
  removeFiles(directory / "frames", [&](const std::string& name) {
    if (!name.ends_with(suffix)) return false;
    return isRecorded(name.substr(0, name.size() - suffix.size()));
  });
  fs::remove(sidecarPath(directory) += suffix);
}

/// Throws InputError where a new recording would replace what this program did not write there.
void refuseForeign(const fs::path& directory) {
  const fs::path frames = directory / "frames";
  std::error_code error;
  if (fs::is_symlink(frames, error)) throw InputError(at(frames), "is a symbolic link, which is not followed");
  requireFree(sidecarPath(directory), {"", 0, ""});
  for (fs::directory_iterator it(frames, error), end; !error && it != end; it.increment(error))
    if (isRecorded(it->path().filename().string())) requireFree(it->path(), {"", 0, ""});
}

/// The error of the file system or of HDF5 while writing, as a RunError.
template <class F>
void writing(const fs::path& directory, F&& write) {
  try {
    write();
  } catch (const fs::filesystem_error& e) {
    throw RunError("cannot write the recording in " + directory.string() + ": " + e.code().message());
  } catch (const hdf5::Error& e) {
    throw RunError("cannot write the recording in " + directory.string() + ": " + e.what());
  }
}

}  // namespace

bool holdsRecording(const fs::path& directory) {
  std::error_code error;
  return fs::exists(layoutPath(directory), error);
}

bool recordsSideBySide() { return hdf5::takesThreads(); }

int closedSegments(const fs::path& directory) {
  std::error_code error;
  if (!holdsRecording(directory)) return 0;
  int count = 0;
  for (fs::directory_iterator it(directory / "frames", error), end; !error && it != end; it.increment(error))
    if (const auto index = segmentIndex(it->path().filename().string())) count = std::max(count, *index + 1);
  return count;
}

struct RecordingWriter::Impl {
  fs::path directory;
  RecordingLayout layout;
  std::vector<FrameInfo> infos;   ///< of all frames, those of the open segment among them
  std::vector<int> segment_ends;  ///< number of frames up to the end of each closed segment
  std::unique_ptr<SegmentBuilder> open;

  SegmentBuilder& segment() {
    if (!open) {
      const int first = segment_ends.empty() ? 0 : segment_ends.back();
      open = std::make_unique<SegmentBuilder>(layout, static_cast<int>(segment_ends.size()), first);
    }
    return *open;
  }
  void writeSidecar() const {
    writeOwnFile(sidecarPath(directory),
                 xdmfSidecar(layout.triangles.size(), layout.body_triangles.size(), infos, segment_ends));
  }
};

RecordingWriter::RecordingWriter(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RecordingWriter::RecordingWriter(RecordingWriter&&) noexcept = default;
RecordingWriter::~RecordingWriter() = default;

RecordingWriter RecordingWriter::create(const fs::path& directory, const RecordingLayout& layout) {
  auto impl = std::make_unique<Impl>();
  impl->directory = directory;
  impl->layout = layout;
  writing(directory, [&] {
    const fs::path frames = directory / "frames";
    refuseForeign(directory);
    fs::create_directories(frames);
    // The layout goes first: without it the directory is no recording, however far the removal gets.
    fs::remove(layoutPath(directory));
    syncDirectory(frames);
    removeUnfinished(directory);
    removeFiles(frames, [](const std::string& name) { return segmentIndex(name).has_value(); });
    fs::remove(sidecarPath(directory));
    syncDirectory(frames);
    syncDirectory(directory);
    writeOwnFile(layoutPath(directory), layoutImage(layout));
  });
  return RecordingWriter(std::move(impl));
}

RecordingWriter RecordingWriter::resume(const fs::path& directory, const RecordingLayout& layout,
                                        Checkpoint& checkpoint) {
  auto impl = std::make_unique<Impl>();
  impl->directory = directory;
  impl->layout = readLayout(directory);
  if (impl->layout.identity != layout.identity)
    throw InputError(at(directory), "the recording there belongs to another case or version (identity " +
                                        impl->layout.identity + ", this run is " + layout.identity + ")");
  if (impl->layout.triangles != layout.triangles || impl->layout.body_triangles != layout.body_triangles ||
      impl->layout.tables != layout.tables)
    throw InputError(at(directory), "the recording there has other triangles or tables than this run");
  const int segments = closedSegments(directory);
  if (segments == 0) throw InputError(at(directory), "the recording there has no closed segment to resume from");
  for (int i = 0; i < segments; ++i) {
    const int first = static_cast<int>(impl->infos.size());
    const SegmentReader segment(directory, impl->layout, i, first);
    for (int f = 0; f < static_cast<int>(segment.times().size()); ++f) impl->infos.push_back(segment.info(first + f));
    impl->segment_ends.push_back(static_cast<int>(impl->infos.size()));
    if (i == segments - 1) checkpoint = segment.checkpoint();
  }
  writing(directory, [&] {
    removeUnfinished(directory);
    impl->writeSidecar();  // the writer may have been killed between a segment and its sidecar
  });
  return RecordingWriter(std::move(impl));
}

void RecordingWriter::append(Frame frame) {
  const double last = impl_->infos.empty() ? -std::numeric_limits<double>::infinity() : impl_->infos.back().time_s;
  if (!std::isfinite(frame.time_s) || !(frame.time_s > last)) throw std::logic_error("frames need ascending times");
  writing(impl_->directory, [&] { impl_->infos.push_back(impl_->segment().add(frame)); });
}

void RecordingWriter::append(TableRow row) {
  writing(impl_->directory, [&] { impl_->segment().add(row); });
}

void RecordingWriter::closeSegment(const Checkpoint& checkpoint) {
  writing(impl_->directory, [&] {
    const int index = static_cast<int>(impl_->segment_ends.size());
    writeOwnFile(segmentPath(impl_->directory, index), impl_->segment().finish(checkpoint));
    impl_->segment_ends.push_back(static_cast<int>(impl_->infos.size()));
    impl_->open.reset();
    impl_->writeSidecar();
  });
}

struct RecordingReader::Impl {
  RecordingLayout layout;
  std::vector<SegmentReader> segments;
  std::vector<double> times;
  std::vector<int> segment_of;  ///< per frame
  TableRows rows;
};

RecordingReader::RecordingReader(const fs::path& directory) : impl_(std::make_unique<Impl>()) {
  impl_->layout = readLayout(directory);
  const int segments = closedSegments(directory);
  if (segments == 0) throw InputError(at(directory), "the recording there has no closed segment yet");
  for (int i = 0; i < segments; ++i) {
    const SegmentReader& segment =
        impl_->segments.emplace_back(directory, impl_->layout, i, static_cast<int>(impl_->times.size()));
    impl_->times.insert(impl_->times.end(), segment.times().begin(), segment.times().end());
    impl_->segment_of.resize(impl_->times.size(), i);
    segment.appendRows(impl_->rows);
  }
}
RecordingReader::RecordingReader(RecordingReader&&) noexcept = default;
RecordingReader::~RecordingReader() = default;

const RecordingLayout& RecordingReader::layout() const { return impl_->layout; }
int RecordingReader::frameCount() const { return static_cast<int>(impl_->times.size()); }
double RecordingReader::time(int frame) const { return impl_->times.at(static_cast<std::size_t>(frame)); }

Frame RecordingReader::frame(int index) const {
  const int segment = impl_->segment_of.at(static_cast<std::size_t>(index));
  return impl_->segments[static_cast<std::size_t>(segment)].frame(index);
}

Field RecordingReader::sampleField(int index, const std::string& name) const {
  const int segment = impl_->segment_of.at(static_cast<std::size_t>(index));
  return impl_->segments[static_cast<std::size_t>(segment)].sampleField(index, name);
}

RecordedTable RecordingReader::table(const std::string& name) const {
  const auto columns = impl_->layout.tables.find(name);
  if (columns == impl_->layout.tables.end()) throw RunError("the recording has no table " + name);
  const auto rows = impl_->rows.find(name);
  return {name, columns->second, rows == impl_->rows.end() ? std::vector<std::vector<double>>{} : rows->second};
}

int RecordingReader::checkpointCount() const { return static_cast<int>(impl_->segments.size()); }

Checkpoint RecordingReader::checkpoint(int index) const {
  return impl_->segments.at(static_cast<std::size_t>(index)).checkpoint();
}

Checkpoint RecordingReader::lastCheckpoint() const { return impl_->segments.back().checkpoint(); }

}  // namespace gambeson
