#include "core/io/recording.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <stdexcept>

#include "core/error.hpp"
#include "core/io/own_file.hpp"

// The HDF5 library (1.10.8) does not free its buffer where a damaged chunk fails to inflate; our own leaks still count.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }

namespace gambeson {
namespace {

namespace fs = std::filesystem;

constexpr int kSamples = 60, kControls = 20, kBody = 7, kFramesPerSegment = 3;

RecordingLayout someLayout() {
  RecordingLayout layout{"case-0123abcd", R"({"title": "Größe \"M\""})", {}, {}};
  for (int i = 0; i + 2 < kSamples; ++i) layout.triangles.push_back({i, i + 1, i + 2});
  for (int i = 0; i + 2 < kBody; ++i) layout.body_triangles.push_back({i + 2, i + 1, i});
  layout.patches = {
      {"front/left", 2, 1, {0, 0, 0, 1, 1, 1}, {0, 0, 0.5, 1, 1}, std::vector<double>(9, 1), {}},
      {"",
       1,
       1,
       {0, 0, 1, 1},
       {0, 0, 1, 1},
       {1, 0.5, 1, 1},
       {{0, 1, {0, 0, 1, 1}, {0.1, 0.1, 0.9, 0.1}, {1, 1}}, {0, 1, {0, 0, 2, 2}, {0.9, 0.1, 0.1, 0.1}, {1, 2}}}}};
  layout.tables = {{"contact", {"time_s", "thigh/left_Ns"}}, {"empty", {"time_s"}}};
  layout.scene = {{"body.mass", {{70.5, -0.0, std::numeric_limits<double>::infinity()}, {}, {}}},
                  {"notes", {{}, {2}, {"a note", ""}}}};
  return layout;
}

/// Frame f of a run, every bit of it a function of f. Noise, so that nothing compresses to nothing; NaN and -0 among
/// it.
Frame someFrame(int f) {
  std::mt19937 random(static_cast<unsigned>(f));
  std::uniform_real_distribution<float> uniform(-1, 1);
  const auto values = [&](int n) {
    std::vector<float> v(static_cast<std::size_t>(n));
    for (float& x : v) x = uniform(random);
    return v;
  };
  Frame frame;
  frame.time_s = 0.1 * f;
  frame.positions = values(3 * kSamples);
  frame.sample_fields = {{"velocity", "m/s", 3, values(3 * kSamples)},
                         {"stress", "N/m", 1, values(kSamples)},
                         {"a/b %c", "", 2, values(2 * kSamples)}};
  frame.sample_fields[1].data[0] = -0.0f;
  frame.sample_fields[2].data[0] = std::numeric_limits<float>::quiet_NaN();
  frame.control_fields = {{"position", "m", 3, values(3 * kControls)}, {"mass", "kg", 1, values(kControls)}};
  frame.body_fields = {{"position", "m", 3, values(3 * kBody)}, {"pressure", "Pa", 1, values(kBody)}};
  return frame;
}

TableRow someRow(int f) { return {"contact", {0.1 * f, std::sqrt(2.0) * f}}; }

/// The state after frame f: all that a run needs to go on.
Checkpoint someCheckpoint(int f) {
  Checkpoint c;
  c.time_s = 0.1 * f;
  c.reals = {{"q", {1.0 / 3, -0.0, 1e-300 * f}}, {"contact/history", {}}, {"", {0.1}}};
  c.integers = {{"frame", {f, std::numeric_limits<std::int64_t>::min()}}, {"noise", {}}};
  // Bits that do not compress need their checksum as much as others.
  std::mt19937_64 random(static_cast<unsigned>(f));
  for (int i = 0; i < 500; ++i) c.integers["noise"].push_back(static_cast<std::int64_t>(random()));
  return c;
}

/// Goes on from frame `from` (0 or after a closed segment) until there are `frames`.
void record(RecordingWriter& writer, int from, int frames) {
  for (int f = from; f < frames; ++f) {
    writer.append(someFrame(f));
    writer.append(someRow(f));
    if ((f + 1) % kFramesPerSegment == 0 || f + 1 == frames) writer.closeSegment(someCheckpoint(f));
  }
}

std::string slurp(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void spill(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

/// Relative path -> bytes of every file under a directory.
std::map<std::string, std::string> contentOf(const fs::path& directory) {
  std::map<std::string, std::string> content;
  for (const auto& entry : fs::recursive_directory_iterator(directory))
    if (entry.is_regular_file() && entry.path().filename() != kOwnFiles)
      content[fs::relative(entry.path(), directory).string()] = slurp(entry.path());
  return content;
}

bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

bool same(const std::vector<Field>& a, const std::vector<Field>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Field& x, const Field& y) {
    return x.name == y.name && x.unit == y.unit && x.components == y.components && sameBits(x.data, y.data);
  });
}

bool same(const Frame& a, const Frame& b) {
  return a.time_s == b.time_s && sameBits(a.positions, b.positions) && same(a.sample_fields, b.sample_fields) &&
         same(a.control_fields, b.control_fields) && same(a.body_fields, b.body_fields);
}

void expectSame(const RecordingReader& reader, int frames) {
  ASSERT_EQ(reader.frameCount(), frames);
  const auto rows = reader.table("contact");
  ASSERT_EQ(static_cast<int>(rows.rows()), frames);
  for (int f = 0; f < frames; ++f) {
    EXPECT_EQ(reader.time(f), 0.1 * f);
    EXPECT_TRUE(same(reader.frame(f), someFrame(f))) << "frame " << f;
    for (const Field& field : someFrame(f).sample_fields)
      EXPECT_TRUE(same(std::vector{reader.sampleField(f, field.name)}, std::vector{field})) << field.name;
    EXPECT_THROW(reader.sampleField(f, "none"), RunError);
    const auto row = static_cast<std::size_t>(f);
    EXPECT_EQ(rows.column("time_s")[row], someRow(f).values[0]);
    EXPECT_EQ(rows.column("thigh/left_Ns")[row], someRow(f).values[1]);
  }
}

class RecordingTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "gambeson_recording_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    dir = name;
  }
  void TearDown() override { fs::remove_all(dir); }
  fs::path segment(int i) const { return dir / "r" / "frames" / ("segment_00000" + std::to_string(i) + ".h5"); }
  void recordAll(const fs::path& where, int frames) {
    RecordingWriter writer = RecordingWriter::create(where, someLayout());
    record(writer, 0, frames);
  }
  fs::path dir;
};

TEST_F(RecordingTest, ReadsBackEveryBit) {
  recordAll(dir / "r", 8);
  const RecordingReader reader(dir / "r");
  expectSame(reader, 8);
  const RecordingLayout expected = someLayout();
  EXPECT_EQ(reader.layout().identity, expected.identity);
  EXPECT_EQ(reader.layout().metadata, expected.metadata);
  EXPECT_EQ(reader.layout().triangles, expected.triangles);
  EXPECT_EQ(reader.layout().body_triangles, expected.body_triangles);
  EXPECT_EQ(reader.layout().patches, expected.patches);
  EXPECT_EQ(reader.layout().tables, expected.tables);
  ASSERT_EQ(reader.layout().scene.size(), expected.scene.size());
  for (const auto& [name, values] : expected.scene) {
    const Values& read = reader.layout().scene.at(name);
    EXPECT_EQ(read.reals, values.reals) << name;
    EXPECT_EQ(read.integers, values.integers) << name;
    EXPECT_EQ(read.texts, values.texts) << name;
  }
  EXPECT_TRUE(reader.table("empty").empty());
  EXPECT_THROW(reader.table("absent"), RunError);
  EXPECT_THROW(reader.table("contact").column("thigh/right_Ns"), RunError);
  EXPECT_THROW(reader.frame(8), std::out_of_range);
  const Checkpoint c = reader.lastCheckpoint(), e = someCheckpoint(7);
  EXPECT_EQ(c.time_s, e.time_s);
  EXPECT_EQ(c.reals, e.reals);
  EXPECT_TRUE(std::signbit(c.reals.at("q")[1]));
  EXPECT_EQ(c.integers, e.integers);
  ASSERT_EQ(reader.checkpointCount(), (8 + kFramesPerSegment - 1) / kFramesPerSegment);
  for (int k = 0; k < reader.checkpointCount(); ++k)
    EXPECT_EQ(reader.checkpoint(k).time_s, someCheckpoint(std::min(8, (k + 1) * kFramesPerSegment) - 1).time_s);
  EXPECT_THROW(reader.checkpoint(reader.checkpointCount()), std::out_of_range);
}

/// Recordings from before hold no scene.
TEST_F(RecordingTest, AnEarlierFormatIsRefusedInWords) {
  recordAll(dir / "r", 3);
  const std::filesystem::path layout = dir / "r/frames/layout.h5";
  std::filesystem::copy_file(GAMBESON_SOURCE_DIR "/tests/unit/core/io/layout_of_format_1.h5", layout,
                             std::filesystem::copy_options::overwrite_existing);
  try {
    const RecordingReader reader(dir / "r");
    ADD_FAILURE() << "it was read";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, layout.string());
    EXPECT_NE(std::string(e.what()).find("format 1, and this program reads format 2"), std::string::npos) << e.what();
  }
}

TEST_F(RecordingTest, SameContentSameBytes) {
  const auto before = static_cast<std::uint32_t>(std::time(nullptr));
  recordAll(dir / "a", 7);
  const auto after = static_cast<std::uint32_t>(std::time(nullptr));
  recordAll(dir / "b", 7);
  EXPECT_EQ(contentOf(dir / "a"), contentOf(dir / "b"));
  // Both were written within a second: look for the second itself, which HDF5 would store in each object's header.
  for (const auto& [name, bytes] : contentOf(dir / "a"))
    for (std::uint32_t second = before; second <= after; ++second) {
      const std::string stamp(reinterpret_cast<const char*>(&second), sizeof second);
      EXPECT_EQ(bytes.find(stamp), std::string::npos) << name << " holds the time of its writing";
    }
}

TEST_F(RecordingTest, SegmentsWithoutFramesKeepRowsAndCheckpoint) {
  RecordingWriter writer = RecordingWriter::create(dir / "r", someLayout());
  writer.append(someRow(0));
  writer.closeSegment(someCheckpoint(0));
  writer.closeSegment(someCheckpoint(1));
  const RecordingReader reader(dir / "r");
  EXPECT_EQ(reader.frameCount(), 0);
  EXPECT_EQ(reader.table("contact").rows(), 1u);
  EXPECT_EQ(reader.lastCheckpoint().integers.at("frame")[0], 1);
}

TEST_F(RecordingTest, CreateRemovesOnlyAnEarlierRecording) {
  recordAll(dir / "r", 8);
  spill(dir / "r" / "frames" / "notes.txt", "mine");
  spill(dir / "r" / "frames" / "segment_000009.h5.gambeson.tmp", "half");
  recordAll(dir / "r", 2);
  expectSame(RecordingReader(dir / "r"), 2);
  EXPECT_FALSE(fs::exists(segment(1)));
  EXPECT_FALSE(fs::exists(dir / "r" / "frames" / "segment_000009.h5.gambeson.tmp"));
  EXPECT_EQ(slurp(dir / "r" / "frames" / "notes.txt"), "mine");
}

/// One process of a run: resumes from the last checkpoint, or starts anew where none was closed; records up to
/// `frames`.
void recordOn(const fs::path& where, int frames) {
  if (closedSegments(where) == 0) {
    RecordingWriter writer = RecordingWriter::create(where, someLayout());
    record(writer, 0, frames);
    return;
  }
  Checkpoint checkpoint;
  RecordingWriter writer = RecordingWriter::resume(where, someLayout(), checkpoint);
  record(writer, static_cast<int>(checkpoint.integers.at("frame")[0]) + 1, frames);
}

// A writer killed at 20 random moments, each time a new process, and then finished: the files are those of an
// uninterrupted run, byte for byte.
TEST_F(RecordingTest, KilledAndResumedIsTheUninterruptedOne) {
  const fs::path killed = dir / "killed";
  std::mt19937 random(7);
  std::uniform_int_distribution<useconds_t> moment_us(200, 12000);
  for (int kills = 0; kills < 20; ++kills) {
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      try {
        recordOn(killed, std::numeric_limits<int>::max());
      } catch (...) {
      }
      _exit(1);
    }
    usleep(moment_us(random));
    kill(child, SIGKILL);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status)) << "the writer failed by itself";
    if (closedSegments(killed) > 0) {  // what is closed is readable at any moment
      const RecordingReader reader(killed);
      const int n = reader.frameCount();
      ASSERT_TRUE(same(reader.frame(n - 1), someFrame(n - 1)));
    }
  }
  const int frames = kFramesPerSegment * closedSegments(killed) + 5;
  recordOn(killed, frames);
  recordAll(dir / "whole", frames);
  expectSame(RecordingReader(killed), frames);
  EXPECT_EQ(contentOf(killed), contentOf(dir / "whole"));
}

// Killed in the middle of a write, at every place: the limit on the size of files sends SIGXFSZ when a write reaches
// it, in the layout, a segment, or the sidecar.
TEST_F(RecordingTest, KilledInTheMiddleOfAWrite) {
  recordAll(dir / "whole", 9);
  const auto whole = contentOf(dir / "whole");
  std::size_t largest = 0;
  for (const auto& [name, bytes] : whole) largest = std::max(largest, bytes.size());
  for (rlim_t limit = 500; limit < largest; limit += 1500) {
    const fs::path killed = dir / std::to_string(limit);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      const rlimit none{0, 0}, most{limit, limit};
      setrlimit(RLIMIT_CORE, &none);
      setrlimit(RLIMIT_FSIZE, &most);
      recordOn(killed, 9);
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ);
    if (closedSegments(killed) > 0) {
      expectSame(RecordingReader(killed), kFramesPerSegment * closedSegments(killed));
    }
    recordOn(killed, 9);
    EXPECT_EQ(contentOf(killed), whole) << "killed at byte " << limit;
  }
}

// What a kill can leave at the worst places, placed there by hand: a half-written segment, a half-written sidecar, and
// a sidecar older than the last segment.
TEST_F(RecordingTest, ResumeCleansUpAndCatchesUp) {
  recordAll(dir / "whole", 9);
  recordAll(dir / "r", 6);
  const std::string bytes = slurp(segment(1));
  spill(segment(2) += ".gambeson.tmp", bytes.substr(0, bytes.size() / 2));
  spill(dir / "r" / "frames.xdmf.gambeson.tmp", "<Xdm");
  fs::remove(dir / "r" / "frames.xdmf");
  expectSame(RecordingReader(dir / "r"), 6);
  Checkpoint checkpoint;
  RecordingWriter writer = RecordingWriter::resume(dir / "r", someLayout(), checkpoint);
  EXPECT_TRUE(fs::exists(dir / "r" / "frames.xdmf"));
  EXPECT_EQ(checkpoint.integers, someCheckpoint(5).integers);
  record(writer, 6, 9);
  EXPECT_EQ(contentOf(dir / "r"), contentOf(dir / "whole"));
}

TEST_F(RecordingTest, ResumeNeedsTheSameRun) {
  Checkpoint checkpoint;
  EXPECT_EQ(closedSegments(dir / "absent"), 0);
  EXPECT_THROW(RecordingWriter::resume(dir / "absent", someLayout(), checkpoint), InputError);
  RecordingWriter::create(dir / "r", someLayout());
  EXPECT_EQ(closedSegments(dir / "r"), 0);
  EXPECT_THROW(RecordingWriter::resume(dir / "r", someLayout(), checkpoint), InputError);
  recordAll(dir / "r", 3);
  EXPECT_EQ(closedSegments(dir / "r"), 1);
  const auto refuses = [&](const RecordingLayout& layout, const std::string& word) {
    try {
      RecordingWriter::resume(dir / "r", layout, checkpoint);
      ADD_FAILURE() << "resumed another run: " << word;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
    }
  };
  RecordingLayout other = someLayout();
  other.identity = "case-other";
  refuses(other, "case-other");
  other = someLayout();
  other.triangles.pop_back();
  refuses(other, "triangles");
  other = someLayout();
  other.tables["contact"].push_back("more");
  refuses(other, "tables");
}

TEST_F(RecordingTest, WhereThereIsNoneOrAGap) {
  EXPECT_THROW(RecordingReader(dir / "absent"), InputError);
  fs::create_directories(dir / "r");
  EXPECT_THROW(RecordingReader(dir / "r"), InputError);
  RecordingWriter::create(dir / "r", someLayout());
  EXPECT_THROW(RecordingReader(dir / "r"), InputError);
  recordAll(dir / "r", 9);
  fs::copy(segment(0), dir / "first");
  fs::remove(segment(1));
  EXPECT_THROW(RecordingReader(dir / "r"), InputError);
  fs::copy(dir / "first", segment(1));  // whole, but of another place
  EXPECT_THROW(RecordingReader(dir / "r"), InputError);
}

/// Reads everything; true where that gave the right content, false where it gave an InputError naming `file`.
bool readsRight(const fs::path& recording, const fs::path& file, int frames) {
  try {
    const RecordingReader reader(recording);
    expectSame(reader, frames);
    EXPECT_EQ(reader.lastCheckpoint().integers, someCheckpoint(frames - 1).integers);
    return true;
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().file, file.string()) << e.what();
    return false;
  }
}

TEST_F(RecordingTest, TruncatedFilesAreNamed) {
  recordAll(dir / "r", 6);
  for (const fs::path& file : {segment(0), segment(1), dir / "r" / "frames" / "layout.h5"}) {
    const std::string bytes = slurp(file);
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, bytes.size() / 2, bytes.size() - 1}) {
      spill(file, bytes.substr(0, size));
      EXPECT_FALSE(readsRight(dir / "r", file, 6)) << file << " cut to " << size;
    }
    spill(file, "no HDF5 at all");
    EXPECT_FALSE(readsRight(dir / "r", file, 6));
    spill(file, bytes);
  }
  EXPECT_TRUE(readsRight(dir / "r", segment(0), 6));
}

// One changed byte anywhere: refused by name, or in padding without effect; never a wrong value, never a crash.
TEST_F(RecordingTest, ADamagedByteNeverPassesAsData) {
  recordAll(dir / "r", 3);
  std::mt19937 random(3);
  int refused = 0, trials = 0;
  for (const fs::path& file : {segment(0), dir / "r" / "frames" / "layout.h5"}) {
    const std::string bytes = slurp(file);
    for (int i = 0; i < 250; ++i, ++trials) {
      std::string damaged = bytes;
      damaged[random() % damaged.size()] ^= static_cast<char>(1 + random() % 255);
      spill(file, damaged);
      refused += readsRight(dir / "r", file, 3) ? 0 : 1;
      if (HasFailure()) FAIL() << "byte changed in " << file;
    }
    spill(file, bytes);
  }
  EXPECT_GT(refused, trials / 2);
}

TEST_F(RecordingTest, UnwritableDirectoryIsTheRunsFailure) {
  spill(dir / "file", "not a directory");
  EXPECT_THROW(RecordingWriter::create(dir / "file", someLayout()), RunError);
  EXPECT_THROW(RecordingWriter::create("/proc/gambeson", someLayout()), RunError);
  // The directory vanishes under the writer.
  RecordingWriter writer = RecordingWriter::create(dir / "r", someLayout());
  writer.append(someFrame(0));
  fs::remove_all(dir / "r");
  EXPECT_THROW(writer.closeSegment(someCheckpoint(0)), RunError);
  if (geteuid() != 0) {
    fs::create_directory(dir / "locked");
    fs::permissions(dir / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    EXPECT_THROW(RecordingWriter::create(dir / "locked", someLayout()), RunError);
  }
}

TEST_F(RecordingTest, RefusesWhatWouldNotReadBack) {
  RecordingWriter writer = RecordingWriter::create(dir / "r", someLayout());
  writer.append(someFrame(1));
  EXPECT_THROW(writer.append(someFrame(1)), std::logic_error);
  Frame frame = someFrame(2);
  frame.time_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(writer.append(frame), std::logic_error);
  frame = someFrame(2);
  frame.positions.resize(3 * (kSamples - 1));
  EXPECT_THROW(writer.append(frame), std::logic_error);
  frame = someFrame(2);
  frame.sample_fields[0].data.pop_back();
  EXPECT_THROW(writer.append(frame), std::logic_error);
  frame = someFrame(2);
  frame.control_fields[1].data.pop_back();
  EXPECT_THROW(writer.append(frame), std::logic_error);
  frame = someFrame(2);
  frame.body_fields[1].data.pop_back();
  EXPECT_THROW(writer.append(frame), std::logic_error);
  frame = someFrame(2);
  frame.body_fields.clear();  // its triangles have corners
  EXPECT_THROW(writer.append(frame), std::logic_error);
  EXPECT_THROW(writer.append(TableRow{"absent", {1}}), std::logic_error);
  EXPECT_THROW(writer.append(TableRow{"contact", {1}}), std::logic_error);
}

TEST_F(RecordingTest, SidecarListsClosedFramesOnly) {
  RecordingWriter writer = RecordingWriter::create(dir / "r", someLayout());
  record(writer, 0, 6);
  writer.append(someFrame(6));
  const std::string text = slurp(dir / "r" / "frames.xdmf");
  // Every text between `before` and the next `after`.
  const auto all = [&](const std::string& before, const std::string& after) {
    std::vector<std::string> found;
    for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at + 1)) {
      const std::size_t from = at + before.size();
      found.push_back(text.substr(from, text.find(after, from) - from));
    }
    return found;
  };
  EXPECT_EQ(all("CollectionType=\"Temporal", "\"").size(), 1u);
  const auto times = all("<Time Value=\"", "\"/>");
  ASSERT_EQ(times.size(), 6u);
  for (int f = 0; f < 6; ++f) EXPECT_EQ(std::stod(times[static_cast<std::size_t>(f)]), 0.1 * f);
  std::vector<std::string> elements;
  for (int f = 0; f < 6; ++f) elements.insert(elements.end(), {"58", "5"});
  EXPECT_EQ(all("<Topology TopologyType=\"Triangle\" NumberOfElements=\"", "\""), elements);
  EXPECT_EQ(all("<Grid Name=\"body\"", ">").size(), 6u);
  EXPECT_EQ(all("<Attribute Name=\"stress\" AttributeType=\"Scalar\" Center=\"Node\"", ">").size(), 6u);
  EXPECT_EQ(all("<Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\"", ">").size(), 6u);
  EXPECT_EQ(all("<Attribute Name=\"mass\"", ">").size(), 6u);
  // Every file named is there, relative to the sidecar.
  auto files = all("<DataItem", "</DataItem>");
  EXPECT_EQ(files.size(), 6u * 11);
  for (auto& file : files) {
    file = file.substr(file.find('>') + 1);
    file = file.substr(0, file.find(':'));
    EXPECT_TRUE(fs::exists(dir / "r" / file)) << file;
  }
  EXPECT_EQ(std::count(files.begin(), files.end(), "frames/segment_000001.h5"), 3 * 9);
}

}  // namespace
}  // namespace gambeson
