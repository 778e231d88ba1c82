/// `report`, `render` and `export` read the recording: a finished run gives the same bytes whatever becomes of its case
/// and of the files that it was made of, and frames of another run are refused.

#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <sstream>

#include "cases/command/cli.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

namespace fs = std::filesystem;

int command(const std::vector<std::string>& words, std::string* error = nullptr) {
  std::vector<const char*> arguments{"gambeson"};
  for (const std::string& w : words) arguments.push_back(w.c_str());
  std::ostringstream out, err;
  const int status = runCommand(static_cast<int>(arguments.size()), arguments.data(), out, err);
  if (error) *error = err.str();
  return status;
}

/// A block of 0.4 x 0.4 x 0.1 m, its top at the height z.
std::string block(double z) {
  std::ostringstream out;
  for (int i = 0; i < 8; ++i)
    out << "v " << (i & 1 ? 0.2 : -0.2) << ' ' << (i & 2 ? 0.2 : -0.2) << ' ' << z - (i & 4 ? 0 : 0.1) << '\n';
  for (const char* f : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"}) out << "f " << f << '\n';
  return out.str();
}

/// A square of 0.2 m in four triangles per cell side, flat at the height z.
std::string square(double z) {
  std::ostringstream out;
  constexpr int n = 4;
  out << "g front\n";
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) out << "v " << 0.2 * i / n - 0.1 << ' ' << 0.2 * j / n - 0.1 << ' ' << z << '\n';
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = 1 + i + (n + 1) * j, b = a + 1, c = a + n + 2, d = a + n + 1;
      out << "f " << a << ' ' << b << ' ' << c << "\nf " << a << ' ' << c << ' ' << d << '\n';
    }
  return out.str();
}

// clang-format off
const std::string cloth = R"("fabric": {"thickness": "1 mm", "density": "436 kg/m^3", "young": "0.5 MPa", "poisson": 0.2,
             "bending": {"law": "linear", "rigidity": "1e-4 N m"}},
  "contact": {"friction": 0.1}, "output": {"window": "10 ms", "frame": "10 ms", "checkpoint": "20 ms",
  "pictures": [{"time": "end", "field": "stress", "width": 320, "height": 240}]})";
const std::string arm = R"json({"name": "arm",
  "garment": {"file": {"path": "sleeve.json"}},
  "human": {"urdf": "arm.urdf", "body": "arm_body.json", "motion": {"trajectory": {"file": "arm_flex.csv"}}},
  "obstacles": [{"name": "wall", "mesh": {"file": "wall.obj", "position": [0, 1, 0]}}],
  "supports": [{"fixed": {"edge": "start"}}],
  "dressing": {"settle": "20 ms"}, "time": {"duration": "60 ms"}, )json" + cloth + "}";
const std::string lift = R"json({"name": "lift",
  "garment": {"mesh_file": {"path": "square.obj"}, "model": "triangles"},
  "obstacles": [{"name": "lift", "sequence": {"folder": "frames", "rate": "50 Hz"}}],
  "time": {"duration": "50 ms"}, )json" + cloth + "}";
const std::string strip = R"json({"kind": "static", "name": "strip",
  "sheet": {"file": {"path": "sleeve.json"}},
  "material": {"fabric": {"thickness": "1 mm", "density": 436, "young": "1 MPa", "poisson": 0,
                          "bending": {"law": "linear", "rigidity": "1e-4 N m"}}},
  "supports": [{"edge": "v0", "hold": "xyz"}], "loads": [{"gravity": [0, 0, -0.01]}],
  "solver": {"linear": true}})json";
// clang-format on

/// Inputs in a folder of their own; results beside it.
class RecordingAlone : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const fs::path library = GAMBESON_SOURCE_DIR "/cases/library";
    folder_ = new Folder;
    fs::create_directories(in() / "frames");
    for (const char* file : {"arm.urdf", "arm_body.json", "arm_flex.csv"}) fs::copy_file(library / file, in() / file);
    ASSERT_EQ(command({"draft", (library / "sleeve_flex.json").string(), "--set", "garment.tube.cells_around=8",
                       "--set", "garment.tube.cells_along=4", "-o", (in() / "sleeve.json").string()}),
              0);
    folder_->write("in/wall.obj", block(0));
    folder_->write("in/square.obj", square(0.0012));
    for (int k = 0; k < 4; ++k) folder_->write("in/frames/block" + std::to_string(k) + ".obj", block(0.0005 * k * k));
    folder_->write("in/arm.json", arm);
    folder_->write("in/lift.json", lift);
    folder_->write("in/strip.json", strip);
    for (const char* name : {"arm", "lift", "strip"}) ASSERT_EQ(run(name, name), 0) << name;
  }
  static void TearDownTestSuite() { delete folder_; }

  static fs::path in() { return folder_->path() / "in"; }
  static fs::path results(const std::string& name) { return folder_->path() / name; }
  static int run(const std::string& name, const std::string& out, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"run", (in() / (name + ".json")).string(), "--out", results(out).string()};
    words.insert(words.end(), more.begin(), more.end());
    std::string error;
    const int status = command(words, &error);
    if (status != 0) std::fprintf(stderr, "%s", error.c_str());
    return status;
  }
  /// What a command writes, by file; `status` must be what it gives.
  static std::map<std::string, std::string> written(const std::string& name, int status = 0) {
    const fs::path to = folder_->path() / "written";
    fs::remove_all(to);
    fs::create_directories(to);
    const std::string of = results(name).string();
    const auto expect = [&](std::vector<std::string> words) {
      std::string error;
      EXPECT_EQ(command(words, &error), status) << words[0] << ": " << error;
      if (status != 0) {
        EXPECT_NE(error.find(name), std::string::npos) << error;
        errors_.push_back(error);
      }
    };
    expect({"report", of, "-o", (to / "page.html").string()});
    for (const char* field :
         name == "strip" ? std::vector{"stress", "plain"} : std::vector{"stress", "pressure", "strain", "plain"})
      expect(
          {"render", of, "--field", field, "--size", "320x240", "-o", (to / (std::string(field) + ".png")).string()});
    if (name == "arm") {
      expect({"render", of, "--field", "body_pressure", "--size", "320x240", "-o", (to / "body.png").string()});
      expect({"export", of, "--iges", (to / "cloth.igs").string(), "--opensim", (to / "loads").string()});
    }
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(to))
      if (!entry.path().filename().string().starts_with(".")) files[entry.path().filename()] = content(entry.path());
    return files;
  }
  /// The inputs under another name, or others under their names, while it lives.
  struct Elsewhere {
    fs::path aside = folder_->path() / "aside";
    Elsewhere() { fs::rename(in(), aside); }
    ~Elsewhere() {
      fs::remove_all(in());
      fs::rename(aside, in());
    }
  };

  static Folder* folder_;
  static std::vector<std::string> errors_;
};
Folder* RecordingAlone::folder_ = nullptr;
std::vector<std::string> RecordingAlone::errors_;

TEST_F(RecordingAlone, SameBytesWithoutTheFiles) {
  for (const char* name : {"arm", "lift", "strip"}) {
    const auto before = written(name);
    EXPECT_GE(before.size(), 3u);
    const std::string page = content(results(name) / "report.html");
    EXPECT_EQ(before.at("page.html"), page) << name;
    const Elsewhere gone;
    EXPECT_EQ(written(name), before) << name;
  }
}

TEST_F(RecordingAlone, SameBytesWithOtherFiles) {
  for (const char* name : {"arm", "lift", "strip"}) {
    const auto before = written(name);
    const Elsewhere aside;
    fs::create_directories(in() / "frames");
    for (const auto& entry : fs::recursive_directory_iterator(aside.aside))
      if (entry.is_regular_file()) {
        const fs::path to = in() / fs::relative(entry.path(), aside.aside);
        std::string text = content(entry.path());
        for (std::size_t at = 0; (at = text.find("0.2", at)) != std::string::npos; ++at) text.replace(at, 3, "0.3");
        std::ofstream(to) << text;
      }
    EXPECT_EQ(written(name), before) << name;
    std::ofstream(in() / "sleeve.json") << "no garment";
    std::ofstream(in() / "arm.urdf") << "no human";
    std::ofstream(in() / "square.obj") << "no mesh";
    EXPECT_EQ(written(name), before) << name;
  }
}

TEST_F(RecordingAlone, FramesOfAnotherCaseAreRefused) {
  for (const char* name : {"arm", "lift", "strip"}) {
    const std::string other = std::string(name) + "_other";
    const fs::path frames = results(name) / "frames", aside = results(name) / "own_frames";
    run(name, other,
        name == std::string("strip") ? std::vector<std::string>{"--set", "loads[0].gravity=[0,0,-0.02]"}
                                     : std::vector<std::string>{"--set", "contact.friction=0.2"});
    fs::rename(frames, aside);
    fs::copy(results(other) / "frames", frames);
    errors_.clear();
    EXPECT_TRUE(written(name, 2).empty()) << name;
    for (const std::string& e : errors_) {
      EXPECT_NE(e.find((results(name) / "case.json").string()), std::string::npos) << e;
      EXPECT_NE(e.find(frames.string()), std::string::npos) << e;
    }
    fs::remove_all(frames);
    fs::rename(aside, frames);
  }
}

/// The same words, other files: what they made stands in the frames, and run.json knows whose they are.
TEST_F(RecordingAlone, FramesOfTheSameCaseWithOtherFilesAreRefused) {
  const std::string sleeve = content(in() / "sleeve.json"), body = content(in() / "arm_body.json");
  std::string thicker = body;
  const std::size_t at = thicker.find("0.0588");
  ASSERT_NE(at, std::string::npos) << body;
  thicker.replace(at, 6, "0.0592");
  folder_->write("in/arm_body.json", thicker);
  ASSERT_EQ(run("arm", "arm_thicker"), 0);
  folder_->write("in/arm_body.json", body);
  EXPECT_EQ(content(results("arm") / "case.json"), content(results("arm_thicker") / "case.json"));
  const fs::path frames = results("arm") / "frames", aside = results("arm") / "own_frames";
  fs::rename(frames, aside);
  fs::copy(results("arm_thicker") / "frames", frames);
  errors_.clear();
  EXPECT_TRUE(written("arm", 2).empty());
  for (const std::string& e : errors_) EXPECT_NE(e.find("run.json"), std::string::npos) << e;
  // One segment of it among the run's own is told by the segment itself.
  fs::remove_all(frames);
  fs::rename(aside, frames);
  const fs::path segment = frames / "segment_000001.h5";
  const std::string own = content(segment);
  fs::copy_file(results("arm_thicker") / "frames/segment_000001.h5", segment, fs::copy_options::overwrite_existing);
  EXPECT_TRUE(written("arm", 2).empty());
  std::ofstream(segment, std::ios::binary) << own;
}

TEST_F(RecordingAlone, AChangedCaseIsRefused) {
  const fs::path file = results("arm") / "case.json";
  const std::string text = content(file);
  std::string changed = text;
  const std::size_t at = changed.find("0.1");
  ASSERT_NE(at, std::string::npos);
  std::ofstream(file) << changed.replace(at, 3, "0.2");
  EXPECT_TRUE(written("arm", 2).empty());
  EXPECT_EQ(run("arm", "arm", {"--resume"}), 2);
  fs::remove(file);
  EXPECT_TRUE(written("arm", 2).empty());
  std::ofstream(file) << text;
  EXPECT_EQ(run("arm", "arm", {"--resume"}), 0);  // writes its results again
}

}  // namespace
}  // namespace gambeson
