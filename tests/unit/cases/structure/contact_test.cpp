/// Dynamic cases whose sheet touches obstacles and itself, from file to results.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cases/structure/run.hpp"
#include "core/error.hpp"
#include "core/io/recording.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/structure/table.hpp"

namespace gambeson {
namespace {

/// A sheet of 0.3 m, held along one edge, falls on what `obstacle` says; the air stills it.
std::string onObstacle(const std::string& obstacle) {
  return R"json({
    "kind": "dynamic", "name": "A sheet on something",
    "sheet": {"plate": {"width": 0.3, "height": 0.3, "corner": [-0.15, -0.15, 0.105]}, "cells_u": 8, "cells_v": 8},
    "material": {"fabric": {"thickness": "1.177 mm", "density": "122 kg/m^3", "young": "30 kPa", "poisson": 0.3,
                            "bending": {"law": "linear", "rigidity": "7e-6 N m"}}},
    "supports": [{"edge": "u0", "hold": "xyz"}],
    "loads": [{"gravity": [0, 0, -9.81]}],
    "obstacles": [)json" +
         obstacle + R"json(],
    "contact": {"friction": 0.3},
    "solver": {"scheme": "explicit", "end": 1.2, "drag": 4},
    "output": {"audit": true, "edges": [{"name": "held", "edge": "u0"}], "interval": 0.05, "pictures": []}})json";
}
const std::string ball = R"({"name": "ball", "sphere": {"radius": 0.1, "center": [0, 0, 0]}})";

/// At rest the ball and the held edge bear the weight; nothing goes through.
TEST(StructureWithContact, ASheetComesToRestOnABall) {
  const Folder folder;
  const auto file = folder.write("case.json", onObstacle(ball));
  const auto out = folder.path() / "out";
  runStructure(readStructureCase(file), {.out = out, .threads = 1});
  const auto rows = tableRows(out / "path.csv");
  const double weight = 0.3 * 0.3 * 1.177e-3 * 122 * 9.81;
  EXPECT_EQ(rows.front().at("ball_fz_N"), 0);
  EXPECT_NEAR(rows.back().at("held_rz_N") - rows.back().at("ball_fz_N"), weight, 0.03 * weight);
  EXPECT_LT(rows.back().at("ball_fz_N"), -0.4 * weight);
  const auto s = nlohmann::json::parse(content(out / "summary.json"));
  EXPECT_EQ(s.at("contact").at("deepest_penetration_m"), 0);
  EXPECT_EQ(s.at("contact").at("unsolved_steps"), 0);
  EXPECT_LT(s.at("audit").at("momentum_gap_over_impulses"), 1e-9);
  EXPECT_LT(s.at("audit").at("energy_gap_over_works"), 0.01);
  int checks = 0;
  for (const auto& k : s.at("checks"))
    for (const char* name : {"Energy", "Contacts", "Penetration", "Let through", "Crossings"})
      if (k.at("check") == name) {
        EXPECT_TRUE(k.at("holds")) << k;
        ++checks;
      }
  EXPECT_EQ(checks, 5);
  EXPECT_NE(content(out / "report.html").find("The sheet touches ball, and itself, with Coulomb friction 0.3"),
            std::string::npos);
  // The same bits for any number of threads.
  runStructure(readStructureCase(file), {.out = folder.path() / "two", .threads = 2});
  EXPECT_EQ(content(out / "path.csv"), content(folder.path() / "two/path.csv"));
}

/// An edge that is held in z alone, within the layer of a floor that is pressed on: its samples cannot leave the floor
/// and bear nothing there; floor and edge bear the load together, row by row.
TEST(StructureWithContact, AnEdgeThatCannotMoveBearsNoContact) {
  const Folder folder;
  const auto file = folder.write("case.json", R"json({
    "kind": "dynamic", "name": "A sheet on a floor",
    "sheet": {"plate": {"width": 0.5, "height": 0.5}, "degree": 2, "cells_u": 6, "cells_v": 6},
    "material": {"fabric": {"thickness": "1.177 mm", "density": "122 kg/m^3", "young": "30 kPa", "poisson": 0.3,
                            "bending": {"law": "linear", "rigidity": "7e-6 N m"}}},
    "supports": [{"edge": "u0", "hold": "z"}, {"edge": "v0", "hold": "y"}, {"corner": "u0v0", "hold": "x"}],
    "loads": [{"gravity": [0, 0, -9.81]}, {"pressure": "-100 Pa", "program": "r"}],
    "programs": {"r": [[0, 0], [0.02, 1], [1, 1]]},
    "obstacles": [{"name": "floor", "plane": {"point": [0.25, 0.25, -0.0011765], "normal": [0, 0, 1], "size": 2}}],
    "contact": {"friction": 0.3},
    "solver": {"scheme": "explicit", "end": 0.1, "drag": 5},
    "output": {"interval": 0.002, "pictures": [], "shapes": "none", "edges": [{"name": "held", "edge": "u0"}]}})json");
  runStructure(readStructureCase(file), {.out = folder.path() / "out", .threads = 1});
  const double load = 0.25 * (100 + 1.177e-3 * 122 * 9.81);
  const auto rows = tableRows(folder.path() / "out/path.csv");
  for (const auto& row : rows) EXPECT_LT(std::abs(row.at("floor_fz_N")), 1.5 * load) << row.at("time_s");
  EXPECT_NEAR(rows.back().at("held_rz_N") - rows.back().at("floor_fz_N"), load,
              0.03 * load);  // it still moves in the air
  EXPECT_LT(-rows.back().at("floor_fz_N"), load);
}

/// A support that carries the sheet's edge into the floor, at 0.2 m/s from 0.105 m: no motion keeps both. The run ends
/// there, says where and why, and keeps what came before.
TEST(StructureWithContact, ASupportThatGoesThroughAnObstacleEndsTheRun) {
  const Folder folder;
  const auto file =
      folder.write("case.json", onObstacle(R"({"name": "floor", "plane": {"point": [0, 0, 0], "size": 2}})"));
  const auto out = folder.path() / "out";
  try {
    runStructure(
        readStructureCase(file, {R"(supports=[{"edge": "u0", "hold": "xyz", "move": [0, 0, -0.2], "program": "r"}])",
                                 R"(programs={"r": [[0, 0], [1, 1]]})"}),
        {.out = out, .threads = 1});
    FAIL() << "the edge went through";
  } catch (const RunError& e) {
    const std::string why = e.what();
    EXPECT_NE(why.find("time 0.52"), std::string::npos) << why;
    EXPECT_NE(why.find("cloth that is held at (-0.15,"), std::string::npos) << why;
    EXPECT_NE(why.find("\"floor\" would pass through each other"), std::string::npos) << why;
  }
  EXPECT_NEAR(tableRows(out / "path.csv").back().at("time_s"), 0.525, 1e-3);
  EXPECT_NE(content(out / "report.html").find("would pass through each other"), std::string::npos);
}

/// A mesh file that is gone after the run changes no picture: the recording holds the obstacle.
TEST(StructureWithContact, PicturesNeedNoFileOfTheObstacle) {
  const Folder folder;
  folder.write("roof.obj",
               "v -0.2 -0.2 0\nv 0.2 -0.2 0\nv 0 -0.2 0.1\nv -0.2 0.2 0\nv 0.2 0.2 0\nv 0 0.2 0.1\n"
               "f 1 2 3\nf 4 6 5\nf 1 3 6\nf 1 6 4\nf 2 5 6\nf 2 6 3\nf 1 4 5\nf 1 5 2\n");
  const auto file = folder.write("case.json", onObstacle(R"({"name": "roof", "mesh": {"file": "roof.obj"}})"));
  const auto out = folder.path() / "out";
  runStructure(readStructureCase(file, {"solver.end=0.3"}), {.out = out, .threads = 1});
  EXPECT_LT(tableRows(out / "path.csv").back().at("roof_fz_N"), -1e-2);
  EXPECT_EQ(RecordingReader(out).layout().body_triangles.size(), 8u);
  RenderOptions o;
  o.results = out;
  o.png = folder.path() / "before.png";
  renderStructureResults(o);
  const std::string before = content(o.png);
  std::filesystem::remove(folder.path() / "roof.obj");
  o.png = folder.path() / "again.png";
  renderStructureResults(o);
  EXPECT_TRUE(content(o.png) == before);
}

}  // namespace
}  // namespace gambeson
