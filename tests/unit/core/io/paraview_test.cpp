// What a ParaView user sees of a recording. Skipped, visibly, where there is no pvpython.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/io/recording.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

/// A square of 5 x 4 points lifted by the time, whose stress is 100 N/m per frame plus the point's number; three
/// control points beside it.
Frame squareAt(int f) {
  Frame frame;
  frame.time_s = 0.02 * f;
  Field stress{"stress", "N/m", 1, {}}, velocity{"velocity", "m/s", 3, {}}, uv{"uv", "", 2, {}};
  for (int i = 0; i < 20; ++i) {
    const auto x = static_cast<float>(i % 5), y = static_cast<float>(i / 5);
    frame.positions.insert(frame.positions.end(), {x, y, static_cast<float>(f)});
    stress.data.push_back(static_cast<float>(100 * f + i));
    velocity.data.insert(velocity.data.end(), {0, 0, 50});
    uv.data.insert(uv.data.end(), {x, y});
  }
  frame.sample_fields = {stress, velocity, uv};
  frame.control_fields = {{"position", "m", 3, {0, 0, 9, 1, 0, 9, 0, 1, 9}}, {"mass", "kg", 1, {1, 2, 3}}};
  return frame;
}

/// Six frames in segments of two; a writer `killed` after five of them leaves two closed segments.
void recordSquare(const fs::path& directory, bool killed) {
  RecordingLayout layout{"square", "{}", {}, {}};
  for (int i = 0; i < 15; ++i)
    if (i % 5 < 4) {
      layout.triangles.push_back({i, i + 1, i + 5});
      layout.triangles.push_back({i + 1, i + 6, i + 5});
    }
  RecordingWriter writer = RecordingWriter::create(directory, layout);
  for (int f = 0; f < 6; ++f) {
    writer.append(squareAt(f));
    if (killed && f == 4) kill(getpid(), SIGKILL);
    if (f % 2 == 1) writer.closeSegment({});
  }
}

void expectSeen(const fs::path& directory, int frames) {
  std::vector<double> times;
  for (int f = 0; f < frames; ++f) times.push_back(0.02 * f);
  const double z = frames - 1;
  const nlohmann::json expected = {{"times", times},
                                   {"bounds", {0, 4, 0, 3, z, z}},
                                   {"points", {20, 3}},
                                   {"cells", {24, 3}},
                                   {"arrays", {{"stress", 1}, {"velocity", 3}, {"uv", 2}, {"mass", 1}}},
                                   {"range_last_frame", {100 * z, 100 * z + 19}},
                                   {"range_all_frames", {0, 100 * z + 19}}};
  // From another directory: the paths in the sidecar are relative to the sidecar.
  const std::string command =
      fmt::format("cd / && timeout 120 pvpython --force-offscreen-rendering '{}' '{}' stress --expect '{}' 2>&1",
                  GAMBESON_SOURCE_DIR "/tests/regress/paraview_check.py", directory.string(), expected.dump());
  FILE* pipe = popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string output;
  char buffer[4096];
  while (const std::size_t n = fread(buffer, 1, sizeof buffer, pipe)) output.append(buffer, n);
  EXPECT_EQ(pclose(pipe), 0) << output;
}

class ParaViewTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v pvpython > /dev/null") != 0) GTEST_SKIP() << "pvpython is not installed";
    std::string name = (fs::temp_directory_path() / "gambeson_paraview_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    dir = name;
  }
  void TearDown() override {
    if (!dir.empty()) fs::remove_all(dir);
  }
  fs::path dir;
};

TEST_F(ParaViewTest, OpensARecording) {
  recordSquare(dir, false);
  expectSeen(dir, 6);
}

TEST_F(ParaViewTest, OpensWhatAKilledWriterLeft) {
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    recordSquare(dir, true);
    _exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  expectSeen(dir, 4);
}

}  // namespace
}  // namespace gambeson
