/// Several garments in one case: reading, writing, what is refused, and what the scenario makes of them.

#include <gtest/gtest.h>

#include "cases/wear/scene/scenario.hpp"
#include "unit/cases/malformed.hpp"
#include "unit/shell_of.hpp"

namespace gambeson {
namespace {

// clang-format off
const std::string several = R"json({
  "name": "layered",
  "garments": [
    {"name": "inner", "tube": {"radius": "10 cm", "length": "0.3 m", "cells_around": 12, "cells_along": 8, "patches": 3},
     "position": [0, 0, "8 mm"]},
    {"name": "outer", "samples_per_cell": 3,
     "sheet": {"width": "0.4 m", "height": 0.4, "cells_u": 8, "cells_v": 8},
     "fabric": {"thickness": "2 mm", "surface_density": "0.5 kg/m^2", "young": "60 kPa", "name": "felt",
                "bending": {"law": "linear", "rigidity": "1e-5 N m"}}}
  ],
  "fabric": {
    "thickness": "1 mm", "density": "436 kg/m^3", "young": "1.2 MPa", "name": "shirt",
    "bending": {"law": "zheng", "rigidity": "7e-6 N m", "kappa0": "30 1/m"}
  },
  "supports": [
    {"fixed": {"garment": "inner", "edge": "start"}},
    {"fixed": {"garment": "outer", "edge": "0.v1"}}
  ],
  "contact": {"friction": 0.2},
  "time": {"duration": "1 s"}
})json";
// clang-format on

TEST(SeveralGarments, IsReadAndWrittenAsItIs) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", several));
  ASSERT_EQ(c.garments.size(), 2u);
  EXPECT_EQ(c.garments[0].name, "inner");
  EXPECT_EQ(c.garments[0].position_m, (Vec3{0, 0, 0.008}));
  EXPECT_EQ(fabricOf(c, c.garments[0]).name, "shirt");
  EXPECT_EQ(fabricOf(c, c.garments[1]).name, "felt");
  EXPECT_EQ(c.garments[1].samples_per_cell, 3);
  EXPECT_FALSE(c.contact.layer_m);
  EXPECT_TRUE(c.contact.self);
  const Case again = readCase(folder.write("again.json", writeCase(c)));
  EXPECT_EQ(writeCase(again), writeCase(c));
  EXPECT_EQ(caseIdentity(again), caseIdentity(c));
  const Case other = readCase(folder.path() / "case.json", {"garments[1].fabric.thickness=3 mm", "contact.self=false"});
  EXPECT_EQ(other.garments[1].fabric->thickness_m, 3e-3);
  EXPECT_FALSE(other.contact.self);
  EXPECT_NE(caseIdentity(other), caseIdentity(c));
}

TEST(SeveralGarments, ScenarioHasEachGarmentWithItsOwnSamplesFabricAndSupports) {
  const Folder folder;
  const auto s = buildScenario(readCase(folder.write("case.json", several)));
  const Garment& g = shellOf(*s->model).garment();
  EXPECT_EQ(g.garment_of_patch, (std::vector<int>{0, 0, 0, 1}));
  EXPECT_EQ(s->patch_names, (std::vector<std::string>{"inner patch_0", "inner patch_1", "inner patch_2", "outer"}));
  EXPECT_EQ(s->fabric_names, (std::vector<std::string>{"shirt", "felt"}));
  const Surface& surface = s->model->surface;
  for (int i = 0; i < surface.size(); ++i) {
    const bool outer = surface.patch[i] == 3;
    EXPECT_DOUBLE_EQ(s->model->layer_m[i], outer ? 2e-3 : 1e-3);
    EXPECT_NEAR(s->model->density_kg_per_m2[i], outer ? 0.5 : 0.436, 1e-12);
  }
  EXPECT_EQ(surface.patch_grid_size[3], (std::array<int, 2>{25, 25}));
  EXPECT_EQ(surface.patch_grid_size[0], (std::array<int, 2>{9, 17}));
  ASSERT_EQ(s->supports.size(), 2u);
  EXPECT_EQ(s->supports[0].name, "inner start held");
  EXPECT_EQ(s->supports[0].samples.size(), 24u);
  EXPECT_EQ(s->supports[1].name, "outer edge v1 of patch 0 held");
  for (int sample : s->supports[1].samples) EXPECT_EQ(surface.patch[sample], 3);
  double mean = 0;  // of the inner tube about its axis: moved
  for (const Vec3& p : g.patches[0].points) mean += p.z;
  for (int k : {1, 2})
    for (const Vec3& p : g.patches[k].points) mean += p.z;
  EXPECT_NEAR(mean / static_cast<double>(3 * g.patches[0].points.size()), 0.008, 2e-3);
}

TEST(SeveralGarments, EachMistakeSaysWhereAndWhy) {
  expectRefused(
      several,
      {{"\"garments\": [", "\"garment\": {\"sheet\": {\"width\": 1, \"height\": 1}}, \"garments\": [", 3, "garments",
        "excludes \"garment\""},
       {"\"name\": \"inner\", ", "", 4, "garments[0].name", "required where there are several garments"},
       {"\"name\": \"outer\", ", "\"name\": \"inner\", ", 6, "garments[1].name", "names two garments"},
       {"\"garment\": \"inner\", ", "", 16, "supports[0].fixed.garment", "allowed: inner or outer"},
       {"\"garment\": \"inner\", ", "\"garment\": \"hat\", ", 16, "supports[0].fixed.garment", "no garment \"hat\""},
       {"\"garment\": \"inner\", ", "\"garment\": \"outer\", ", 16, "supports[0].fixed.edge",
        "allowed: u0, u1, v0 or v1"},
       {"\"0.v1\"", "\"1.v1\"", 17, "supports[1].fixed.edge", "there is no patch 1"},
       {"\"contact\": {\"friction\": 0.2},", "", 1, "contact", "a second garment"},
       {"\"friction\": 0.2", "\"friction\": 0.2, \"self\": 1", 19, "contact.self", "expected true or false"},
       {"\"position\": [0, 0, \"8 mm\"]", "\"position\": [0, 0, \"nan m\"]", 5, "garments[0].position[2]",
        "not a finite number"},
       {"\"2 mm\"", "\"-2 mm\"", 8, "garments[1].fabric.thickness", "out of range"},
       {"\"samples_per_cell\": 3", "\"samples_per_cell\": 9", 6, "garments[1].samples_per_cell", "out of range"},
       {"\"sheet\": {\"width\": \"0.4 m\", \"height\": 0.4, \"cells_u\": 8, \"cells_v\": 8}", "\"shorts\": {}", 7,
        "garments[1].shorts", "the case has none"}});
}

TEST(SeveralGarments, FabricIsNamedOnceForEach) {
  const Folder folder;
  const std::string own = R"("position": [0, 0, "8 mm"], "fabric": {"thickness": "1 mm", "density": 400, "young": 1e6,
    "bending": {"law": "linear", "rigidity": 1e-5}})";
  const auto refused = [&](const std::string& text, const std::string& reason) {
    try {
      readCase(folder.write("case.json", text));
      ADD_FAILURE() << "accepted";
    } catch (const InputError& e) {
      EXPECT_EQ(e.where().key, "fabric");
      EXPECT_NE(e.reason().find(reason), std::string::npos) << e.what();
    }
  };
  refused(replaced(several, "\"position\": [0, 0, \"8 mm\"]", own), "is of no use");
  const std::size_t from = several.find("  \"fabric\": {\n"), to = several.find("  \"supports\"");
  std::string without = several;
  without.erase(from, to - from);
  refused(without, "is required");
  EXPECT_NO_THROW(readCase(folder.write("case.json", replaced(without, "\"position\": [0, 0, \"8 mm\"]", own))));
  std::string none = several;
  const std::size_t list = none.find("\"garments\": ["), end = none.find("  \"fabric\": {\n");
  none.replace(list, end - list, "\"garments\": [],\n");
  try {
    readCase(folder.write("case.json", none));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(e.where().key, "garments") << e.what();
  }
}

TEST(SeveralGarments, NoiseMovesTheStartAndNotTheRestShape) {
  const Folder folder;
  const auto plain = buildScenario(readCase(folder.write("case.json", several)));
  const auto noisy = buildScenario(readCase(folder.path() / "case.json", {"garments[1].noise=1 mm"}));
  StepWork work;
  const State a = startOf(*plain, work), b = startOf(*noisy, work);
  EXPECT_EQ(plain->model->mass_kg, noisy->model->mass_kg);
  double largest = 0;
  for (std::size_t i = 0; i < a.p.size(); ++i) {
    const Vec3 moved = b.p[i] - a.p[i];
    const bool outer = plain->model->cloth->map().home[i] >= controlOffsets(shellOf(*plain->model).garment())[3];
    if (!outer || plain->model->held[i]) {
      EXPECT_EQ(moved, Vec3{}) << i;
    }
    EXPECT_NEAR(norm(moved), std::abs(moved.z), 1e-15);  // the sheet's normal
    largest = std::max(largest, norm(moved));
  }
  EXPECT_LE(largest, 1e-3);
  EXPECT_GT(largest, 0.9e-3);
  const auto other =
      buildScenario(readCase(folder.path() / "case.json", {"garments[1].noise=1 mm", "garments[1].noise_seed=2"}));
  EXPECT_NE(startOf(*other, work).p, b.p);
}

TEST(SeveralGarments, PinnedPointStaysAndTorusIsARing) {
  const Folder folder;
  const std::string pinned =
      replaced(replaced(several, R"({"fixed": {"garment": "outer", "edge": "0.v1"}})",
                        R"({"pinned": {"garment": "outer", "s": 0.5, "t": 0.25}})"),
               "\"contact\"",
               R"("obstacles": [{"name": "ring", "torus": {"radius": "40 mm", "tube": "5 mm", "center": [0, 1, 0],
                 "axis": [1, 1, 0], "segments": 200, "rings": 60}}], "contact")");
  const auto s = buildScenario(readCase(folder.write("case.json", pinned)));
  EXPECT_EQ(s->supports[1].name, "outer point (0.5, 0.25) held");
  // 8 cells of degree 2: the point lies on knots both ways, so four control points shape it.
  const int outer = controlOffsets(shellOf(*s->model).garment())[3];
  int held = 0;
  for (std::size_t i = 0; i < s->model->held.size(); ++i)
    held += s->model->held[i] && s->model->cloth->map().home[i] >= outer;
  EXPECT_EQ(held, 4);
  const TriangleMesh& ring = std::get<TriangleMesh>(s->model->obstacles[0].shape);
  double volume = 0;  // 2 pi^2 R r^2, the normals outward
  for (const auto& [a, b, c] : ring.triangles)
    volume += dot(ring.vertices[a], cross(ring.vertices[b], ring.vertices[c])) / 6;
  EXPECT_NEAR(volume / (2 * M_PI * M_PI * 0.04 * 25e-6), 1, 5e-3);
  const std::vector<Placement> placed = s->obstaclePlacements(0);
  EXPECT_NEAR(s->model->proximity->signedDistance(0, placed[0], {0, 1, 0}), 0.035, 1e-4);
  EXPECT_NEAR(s->model->proximity->signedDistance(0, placed[0], Vec3{0, 1, 0.04}), -0.005, 1e-4);
  expectRefused(pinned, {{"\"t\": 0.25", "\"t\": 1.25", 17, "supports[1].pinned.t", "out of range"},
                         {"\"t\": 0.25", "\"patch\": 1", 17, "supports[1].pinned.patch", "there is no patch 1"},
                         {"\"garment\": \"outer\", \"s\"", "\"s\"", 17, "supports[1].pinned.garment", "is required"},
                         {"\"tube\": \"5 mm\"", "\"tube\": \"50 mm\"", 19, "obstacles[0].torus.tube", "< radius"}});
}

}  // namespace
}  // namespace gambeson
