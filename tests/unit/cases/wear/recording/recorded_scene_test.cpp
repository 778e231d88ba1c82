/// A scene out of a recording is the one that went in, to the bit: bodies at all times that results ask for, cloth,
/// regions, notes.

#include "cases/wear/recording/recorded_scene.hpp"

#include <gtest/gtest.h>

#include "cases/wear/case/motions/kind.hpp"
#include "cases/wear/case/strides.hpp"
#include "cases/wear/recording/recorded_motion.hpp"
#include "cases/wear/recording/recorder.hpp"
#include "cases/wear/recording/windows.hpp"
#include "core/error.hpp"
#include "human/motion/inverse_statics.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

void expectSameMotion(const Scenario& a, const Scenario& b, double t) {
  const Posture p = a.motion->at(t), q = b.motion->at(t);
  EXPECT_EQ(p.q, q.q) << t;
  EXPECT_EQ(p.root, q.root) << t;
}

/// At the bounds and the middles of windows, where frames stand and torques are taken.
void expectSameBodies(const Scenario& a, const Scenario& b) {
  const Windows windows(a.start_s, a.end_s, a.definition.output.window_s);
  for (long k = 0; k < windows.count(); ++k) {
    const double middle = 0.5 * (windows.bound(k) + windows.bound(k + 1));
    for (const double t : {windows.bound(k), middle, windows.bound(k + 1)}) {
      EXPECT_EQ(a.obstaclePlacements(t), b.obstaclePlacements(t)) << t;
      EXPECT_EQ(a.bodyPoses(t), b.bodyPoses(t)) << t;
      EXPECT_EQ(deformedVertices(*a.model, *a.stage, t), deformedVertices(*b.model, *b.stage, t)) << t;
    }
    if (a.motion && middle > 0)
      for (const double t : {middle - kRate_s, middle + kRate_s}) expectSameMotion(a, b, t);
  }
}

void expectSameCloth(const Scenario& a, const Scenario& b) {
  const Surface &s = a.model->surface, &t = b.model->surface;
  EXPECT_EQ(a.model->cloth->rest(), b.model->cloth->rest());
  EXPECT_EQ(s.triangles, t.triangles);
  EXPECT_EQ(s.patch, t.patch);
  EXPECT_EQ(s.area_m2, t.area_m2);
  EXPECT_EQ(s.W.values, t.W.values);
  EXPECT_EQ(a.model->layer_m, b.model->layer_m);
  EXPECT_EQ(a.model->density_kg_per_m2, b.model->density_kg_per_m2);
  EXPECT_EQ(a.patch_names, b.patch_names);
  EXPECT_EQ(a.contact_region, b.contact_region);
  EXPECT_EQ(a.contact_regions, b.contact_regions);
  EXPECT_EQ(a.contact_group, b.contact_group);
}

class RecordedSceneOf : public testing::TestWithParam<std::pair<const char*, std::vector<std::string>>> {};

TEST_P(RecordedSceneOf, IsTheSceneOfTheRun) {
  const auto& [name, overrides] = GetParam();
  const auto made = buildScenario(libraryCase(name, overrides));
  const auto read = scenarioOf(made->definition, sceneOf(*made), "frames");
  EXPECT_EQ(made->notes, read->notes);
  EXPECT_EQ(made->facts, read->facts);
  EXPECT_EQ(made->bodies, read->bodies);
  EXPECT_EQ(made->start_s, read->start_s);
  EXPECT_EQ(made->end_s, read->end_s);
  EXPECT_EQ(made->feet.has_value(), read->feet.has_value());
  expectSameBodies(*made, *read);
  expectSameCloth(*made, *read);
  if (!made->motion) return;
  if (const auto strides = stridesOf(made->definition))
    for (const double t : strides->thousandths()) expectSameMotion(*made, *read, t);
  for (const double t : hundredthsOf(*made->motion)) expectSameMotion(*made, *read, t);
  EXPECT_EQ(made->motion->stairs().has_value(), read->motion->stairs().has_value());
}

INSTANTIATE_TEST_SUITE_P(
    Library, RecordedSceneOf,
    testing::Values(
        // A URDF, a body file, a trajectory.
        std::pair("sleeve_flex", std::vector<std::string>{"garment.tube.cells_around=8", "garment.tube.cells_along=4",
                                                          "time.duration=0.1"}),
        // A garment from a file, trimmed, with a seam.
        std::pair("tangle_sleeve", std::vector<std::string>{"time.duration=0.05"}),
        // Ellipsoids that are projected, and walk.
        std::pair("shorts_walk",
                  std::vector<std::string>{"garment.shorts.cell=50 mm", "time.duration=0.1",
                                           R"(dressing.projecting={"clearance": "5 mm", "grow": "0.1 s"})"}),
        // A skin that is projected.
        std::pair("skirt_tryon", std::vector<std::string>{"time.duration=0.05", "dressing.settle=50 ms",
                                                          "dressing.projecting.clearance=20 mm"}),
        // Drafts over drafts, a belt that starts stretched, cloth that bends from a posture of dressing to another.
        std::pair("armour_aim", std::vector<std::string>{"time.duration=0.05", "dressing.settle=50 ms"}),
        std::pair("stack_of_ten", std::vector<std::string>{"time.duration=0.05"})),
    [](const auto& test) { return std::string(test.param.first); });

TEST(RecordedScene, KeepsBridgedFolds) {
  const auto made = buildScenario(libraryCase("shorts_walk_skin", {"garment.shorts.cell=50 mm", "time.duration=0.05"}));
  const DeformedVertices bare = deformedVertices(*made->model, *made->stage, 0.03);
  made->stage->bridged = {.begin_s = 0,
                          .every_s = 0.02,
                          .first = {0, 1, 3, 3},
                          .vertex = {7, 7, 9},
                          .way = {{0.01, 0, 0}, {0, 0.02, 0}, {0, 0, 0.03}}};
  const auto read = scenarioOf(made->definition, sceneOf(*made), "frames");
  EXPECT_NE(deformedVertices(*made->model, *made->stage, 0.03), bare);
  expectSameBodies(*made, *read);
}

TEST(RecordedScene, OtherTimesThanThoseAskedForAreAnError) {
  const auto made = buildScenario(
      libraryCase("sleeve_flex", {"garment.tube.cells_around=8", "garment.tube.cells_along=4", "time.duration=0.1"}));
  const RecordedMotion motion(posturesOf(*made));
  EXPECT_NO_THROW(motion.at(0.05));
  EXPECT_NO_THROW(motion.at(0.05 + 1e-12));  // bounds of windows are added up
  EXPECT_THROW(motion.at(0.0507), RunError);
}

TEST(RecordedScene, DamageIsNamed) {
  const auto made = buildScenario(libraryCase("stack_of_ten"));
  auto scene = sceneOf(*made);
  scene.at("garments.patches.points").reals.pop_back();
  try {
    scenarioOf(made->definition, scene, "frames/layout.h5");
    ADD_FAILURE() << "a point is missing";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("frames/layout.h5"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("garments.patches.points"), std::string::npos) << e.what();
  }
}

/// "x" with its part "_n_Ns", "x_n" with its part "_Ns".
TEST(RecordedScene, ColumnsOfOneNameAreRefusedBeforeTheRun) {
  const auto clash = buildScenario(libraryCase("stack_of_ten", {R"(obstacles=[
      {"name": "x", "sphere": {"center": [0, 0, -1], "radius": 0.1}},
      {"name": "x_n", "sphere": {"center": [0, 1, -1], "radius": 0.1}}])"}));
  EXPECT_THROW(recordingLayout(*clash), InputError);
}

TEST(RecordedScene, NamesOfTablesAreToldApart) {
  EXPECT_EQ(toldApart({"a", "b", "a", "a 2", "a"}), (std::vector<std::string>{"a", "b", "a 2", "a 2 2", "a 3"}));
}

}  // namespace
}  // namespace gambeson
