/// `gambeson export`: what other programs get is what the recording holds.

#include "cases/wear/run/export.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "analysis/animation/glb.hpp"
#include "cases/cad/cad_file.hpp"
#include "cases/cad/tidy.hpp"
#include "cases/command/cli.hpp"
#include "cases/wear/results/animation.hpp"
#include "cases/wear/results/results.hpp"
#include "cases/wear/results/shown.hpp"
#include "core/error.hpp"
#include "human/recorded/storage.hpp"
#include "unit/analysis/animation/glb_reader.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"

namespace gambeson {
namespace {

int command(std::vector<const char*> words, std::string* error = nullptr) {
  words.insert(words.begin(), "gambeson");
  std::ostringstream out, err;
  const int status = runCommand(static_cast<int>(words.size()), words.data(), out, err);
  if (error) *error = err.str();
  return status;
}

/// The library's arm in a coarse sleeve, for a few hundredths of a second.
class Export : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new Folder;
    results_ = (folder_->path() / "run").string();
    ASSERT_EQ(command({"run", GAMBESON_SOURCE_DIR "/cases/library/sleeve_flex.json", "--out", results_.c_str(), "--set",
                       "garment.tube.cells_around=8", "--set", "garment.tube.cells_along=4", "--set",
                       "time.duration=0.06", "--set", "output.pictures=[]"}),
              0);
  }
  static void TearDownTestSuite() { delete folder_; }
  static Folder* folder_;
  static std::string results_;
};
Folder* Export::folder_ = nullptr;
std::string Export::results_;

TEST_F(Export, OpenSimGetsTheForcesOfTheLedger) {
  const std::string prefix = (folder_->path() / "loads").string();
  ASSERT_EQ(command({"export", results_.c_str(), "--opensim", prefix.c_str()}), 0);
  const StorageTable table = readStorage(prefix + ".mot");
  const RecordingReader recording(results_);
  const RecordedTable bodies = recording.table("bodies");
  const std::vector<double>&start = bodies.column("start_s"), &end = bodies.column("end_s");
  std::size_t row = 0;
  double most = 0;
  for (std::size_t w = 0; w < bodies.rows(); ++w) {
    if (start[w] < -1e-9) continue;
    Vec3 ledger, file;
    for (const std::string& name : recording.layout().tables.at("bodies")) {
      const double mean = bodies.column(name)[w] / (end[w] - start[w]);
      if (name.ends_with("_Jx_Ns")) ledger.x += mean;
      if (name.ends_with("_Jy_Ns")) ledger.y += mean;
      if (name.ends_with("_Jz_Ns")) ledger.z += mean;
    }
    for (std::size_t c = 0; c < table.names.size(); ++c) {
      if (table.names[c].ends_with("_force_vx")) file.x += table.columns[c][row];
      if (table.names[c].ends_with("_force_vy")) file.z += table.columns[c][row];
      if (table.names[c].ends_with("_force_vz")) file.y -= table.columns[c][row];
    }
    EXPECT_LT(norm(file - ledger), 1e-12);
    most = std::max(most, norm(ledger));
    ++row;
  }
  EXPECT_EQ(row, table.times.size());
  EXPECT_GT(most, 0.01);  // the sleeve touched the arm
}

TEST_F(Export, CadGetsTheControlPointsOfTheFrame) {
  const std::string iges = (folder_->path() / "sleeve.igs").string();
  ASSERT_EQ(command({"export", results_.c_str(), "--iges", iges.c_str(), "--time", "end"}), 0);
  const RecordingReader recording(results_);
  const Frame frame = recording.frame(recording.frameCount() - 1);
  // All numbers of the parameter section; the control points follow each other in one of them.
  std::vector<double> numbers;
  std::istringstream in(content(iges));
  std::string data;
  for (std::string line; std::getline(in, line);)
    if (line[72] == 'P') data += line.substr(0, line.find_last_not_of(' ', 63) + 1);
  for (char& c : data) c = c == ',' || c == ';' ? ' ' : c == 'D' ? 'E' : c;
  std::istringstream words(data);
  for (std::string word; words >> word;)
    if (word.find('H') == std::string::npos) numbers.push_back(std::stod(word));
  std::vector<double> expected;
  for (const float x : frame.control_fields.at(0).data) expected.push_back(1e3 * static_cast<double>(x));
  EXPECT_NE(std::search(numbers.begin(), numbers.end(), expected.begin(), expected.end(),
                        [](double a, double b) { return std::abs(a - b) < 1e-9; }),
            numbers.end());
  // And the recording tells the rest of the surface.
  ASSERT_EQ(recording.layout().patches.size(), 1u);
  const PatchLayout& patch = recording.layout().patches[0];
  EXPECT_EQ((patch.knots_u.size() - static_cast<std::size_t>(patch.degree_u) - 1) *
                (patch.knots_v.size() - static_cast<std::size_t>(patch.degree_v) - 1) * 3,
            expected.size());
  EXPECT_EQ(patch.weights.size() * 3, expected.size());
}

/// Read back by OpenCASCADE: every control point, names, areas; and the same bytes each time.
TEST_F(Export, CadFilesComeBack) {
  const RecordingReader recording(results_);
  const Frame frame = recording.frame(recording.frameCount() - 1);
  const std::vector<float>& x = frame.control_fields.at(0).data;
  for (const std::string ending : {"step", "igs"}) {
    const std::string file = (folder_->path() / ("back." + ending)).string(),
                      again = (folder_->path() / ("again." + ending)).string();
    for (const std::string& f : {file, again})
      ASSERT_EQ(command({"export", results_.c_str(), "-o", f.c_str(), "--time", "end"}), 0);
    EXPECT_EQ(content(file), content(again)) << ending;
    const CadShape shape = readCad(file);
    ASSERT_EQ(shape.faces.size(), 1u);
    EXPECT_EQ(shape.faces[0].name, recording.layout().patches[0].name) << ending;
    const NurbsPatch& patch = shape.faces[0].patch;
    ASSERT_EQ(3 * patch.points.size(), x.size());
    double most = 0;
    for (std::size_t k = 0; k < patch.points.size(); ++k)
      most = std::max(most, norm(patch.points[k] - Vec3{x[3 * k], x[3 * k + 1], x[3 * k + 2]}));
    EXPECT_LT(most, 1e-12) << ending;
    EXPECT_NEAR(shape.faces[0].area_m2, areaOf(patch, {}), 1e-6 * shape.faces[0].area_m2) << ending;
  }
}

/// Three times: the links where their joints put them, and every vertex of the cloth.
TEST_F(Export, AnimationsHaveTheJointsAndTheClothOfTheRecording) {
  const std::string file = (folder_->path() / "sleeve.glb").string();
  ASSERT_EQ(command({"export", results_.c_str(), "-o", file.c_str(), "--field", "pressure"}), 0);
  const GlbReader glb(content(file));
  const RecordedRun run = recordedRun(results_);
  const Scenario& s = *run.scenario;
  const std::vector<WornMesh> garments = wornMeshes(s);
  ASSERT_EQ(garments.size(), 1u);
  const int first = run.recording.frameCount() - static_cast<int>(glb.times().size());
  ASSERT_GE(first, 0);
  double most = 0;
  for (const std::size_t k : {std::size_t{0}, glb.times().size() / 2, glb.times().size() - 1}) {
    const Frame frame = run.recording.frame(first + static_cast<int>(k));
    EXPECT_NEAR(glb.times()[k], frame.time_s - run.recording.time(first), 1e-6);
    const Posture posture = s.motion->at(frame.time_s);
    const std::vector<Pose> X_WL = linkPoses(s.human->skeleton, posture.q, posture.root);
    for (std::size_t l = 0; l < X_WL.size(); ++l)
      EXPECT_LT(norm(glb.inOurs(glb.node(s.human->skeleton.links[l].name), k, {}) - X_WL[l].origin), 1e-6);
    const std::vector<Vec3> x = glb.vertices(glb.node("garment", true), k);
    ASSERT_EQ(x.size(), garments[0].samples.size());
    for (std::size_t v = 0; v < x.size(); ++v) {
      const float* of = frame.positions.data() + 3 * garments[0].samples[v];
      most = std::max(most, norm(x[v] - Vec3{of[0], of[1], of[2]}));
    }
  }
  EXPECT_LT(most, 2e-5);  // an arm long, in 32766 steps
  EXPECT_NE(glb.json["asset"]["extras"]["colors"].get<std::string>().find("[kPa]"), std::string::npos);
}

TEST_F(Export, FramesAreThinnedEvenly) {
  const std::string all = (folder_->path() / "all.glb").string(), few = (folder_->path() / "few.glb").string();
  ASSERT_EQ(command({"export", results_.c_str(), "-o", all.c_str()}), 0);
  ASSERT_EQ(command({"export", results_.c_str(), "-o", few.c_str(), "--frames", "3"}), 0);
  const std::vector<double> every = GlbReader(content(all)).times(), some = GlbReader(content(few)).times();
  ASSERT_EQ(some.size(), 3u);
  EXPECT_EQ(some.front(), every.front());
  EXPECT_EQ(some.back(), every.back());
  EXPECT_NEAR(some[1], 0.5 * every.back(), 0.6 * every[1]);
}

/// The size is told from two frames within 1 %; what would be larger has as many as fit.
TEST_F(Export, AnimationsKeepBelowTheirLargestSize) {
  ExportOptions o;
  o.results = results_;
  o.glb = folder_->path() / "whole.glb";
  exportResults(o);
  const auto whole = static_cast<double>(content(o.glb.string()).size());
  const std::size_t frames = GlbReader(content(o.glb.string())).times().size();
  const RecordedRun run = recordedRun(results_);
  EXPECT_EQ(animatedFrames(run.recording), frames);
  AnimationOptions two;
  two.frames = 2;
  two.color_frame = run.recording.frameCount() - 1;
  const GlbSize size = glbSize(animationOf(*run.scenario, run.recording, two).scene);
  EXPECT_NEAR(size.bytes(frames), whole, 0.01 * whole);
  o.glb = folder_->path() / "part.glb";
  o.largest_glb = (size.bytes(3) + 1) / 0.99;  // a hundredth is left for what is not known of it
  exportResults(o);
  const std::string part = content(o.glb.string());
  EXPECT_LE(static_cast<double>(part.size()), o.largest_glb);
  EXPECT_NEAR(static_cast<double>(part.size()), size.bytes(3), 0.01 * size.bytes(3));
  EXPECT_EQ(GlbReader(part).times().size(), 3u);
  o.largest_glb = 1000;
  EXPECT_THROW(exportResults(o), RunError);
}

TEST_F(Export, WhatCannotBeWrittenIsSaid) {
  std::string error;
  EXPECT_EQ(command({"export", results_.c_str()}, &error), 2);
  EXPECT_NE(error.find("nothing to write"), std::string::npos) << error;
  EXPECT_EQ(command({"export", (folder_->path() / "none").c_str(), "--iges", "x.igs"}, &error), 2);
  EXPECT_EQ(command({"export", results_.c_str(), "--iges", "x.igs", "--time", "noon"}, &error), 2);
  EXPECT_NE(error.find("time"), std::string::npos) << error;
  EXPECT_EQ(command({"export", results_.c_str(), "-o", "walk.mp4"}, &error), 2);
  EXPECT_NE(error.find("allowed: a name that ends in .glb, .obj, .igs, .iges, .step or .stp"), std::string::npos)
      << error;
  EXPECT_EQ(command({"export", results_.c_str(), "-o", "a.igs", "--iges", "b.igs"}, &error), 2);
  EXPECT_NE(error.find("second file of its format"), std::string::npos) << error;
  EXPECT_EQ(command({"export", results_.c_str(), "--iges", "/nowhere/at/all/x.igs"}, &error), 2);
  EXPECT_NE(error.find("--iges: there is no folder /nowhere/at/all"), std::string::npos) << error;
}

}  // namespace
}  // namespace gambeson
