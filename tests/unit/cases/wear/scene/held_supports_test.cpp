/// Supports of a case that move what they hold and let go of it.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/wear/run/run.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/malformed.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

const std::string sheet = R"json({
  "name": "sheet",
  "garment": {"sheet": {"width": 0.2, "height": 0.2, "cells_u": 6, "cells_v": 6, "corner": [0, 0, 0]}},
  "fabric": {"thickness": "0.5 mm", "surface_density": 0.15, "young": "200 kPa", "poisson": 0.2,
             "bending": {"law": "hysteresis", "rigidity": 1.4e-5, "loop": {"axes": "isotropic", "initial_rigidity": 4.64e-5,
                         "c1": -2.15e-7, "set": 5, "fatigue": 0.3}}},
  "supports": [{"fixed": {"edge": "u0", "drive": {"velocity": [[0, 0, 0, 0], [0.1, 0, 0, 0.5], [0.2, 0, 0, 0]],
                                                  "spin": [[0.1, 8]], "axis": [0, 1, 0]}}},
               {"pinned": {"s": 1, "t": 0, "release": "0.15 s"}}],
  "contact": {"friction": 0.2},
  "air": {"drag": 0.4},
  "time": {"duration": 0.4, "max_step": "0.25 ms"},
  "output": {"checkpoint": "100 ms", "frame": "20 ms", "pictures": [{"time": "end", "field": "set"}, {"time": "end", "field": "friction"}]}
})json";

TEST(HeldSupports, MoveAndLetGo) {
  const Folder folder;
  for (const char* model : {R"(garment.model="nurbs")", R"(garment.model="triangles")"}) {
    const Case c = readCase(folder.write("case.json", sheet), {model});
    ASSERT_EQ(runCase(c, {folder.path() / "out", 1, false}), 0);
    const auto j = nlohmann::json::parse(content(folder.path() / "out/summary.json"));
    EXPECT_LT(j.at("momentum").at("largest_error_ratio").get<double>(), 1e-9);
    EXPECT_LT(std::abs(j.at("energy").at("drift_ratio").get<double>()), 0.02);
    EXPECT_GT(j.at("energy").at("work_supports_J").get<double>(), 0);
    const auto& memory = j.at("memory").at(0);
    EXPECT_GT(memory.at("set_1_per_m").get<double>(), 0);
    EXPECT_GE(memory.at("largest_set_1_per_m").get<double>(), memory.at("set_1_per_m").get<double>());
    EXPECT_LT(memory.at("friction_left").get<double>(), 1);
    EXPECT_EQ(content(folder.path() / "out/memory.csv").rfind("time_s,", 0), 0u);
  }
}

/// A patch that is held whole goes where its drive says.
TEST(HeldSupports, HoldAPatchWhole) {
  const Folder folder;
  SceneRun scene(readCase(folder.write("case.json", sheet),
                          {R"(supports=[{"patch": {"drive": {"velocity": [[0, 1, 0, 0]]}}}])"}));
  const Vec3 start = centreOfMass(scene.model, scene.state);
  scene.run(0.1, [](const State&, const State&, const StepReport&, const StepResult&, const Frequency&) {});
  EXPECT_LT(norm(centreOfMass(scene.model, scene.state) - start - Vec3{0.1, 0, 0}), 1e-12);
}

TEST(HeldSupports, AreWrittenAsTheyWereRead) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", sheet));
  const Case again = readCase(folder.write("again.json", writeCase(c)));
  const auto& drive = std::get<FixedSupport>(again.supports[0]).drive;
  EXPECT_EQ(drive, std::get<FixedSupport>(c.supports[0]).drive);
  EXPECT_EQ(drive.spin_rad_per_s.at(0.05), 0);
  EXPECT_EQ(drive.spin_rad_per_s.at(7), 8);
  EXPECT_NEAR(drive.velocity_m_per_s.at(0.05).z, 0.25, 1e-15);
  EXPECT_EQ(std::get<PinnedSupport>(again.supports[1]).release_s, 0.15);
}

TEST(HeldSupports, ThatContradictEachOtherAreRefused) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", sheet),
                          {R"(supports=[{"fixed": {"edge": "u0", "drive": {"velocity": [[0, 1, 0, 0]]}}}, {"fixed": {"edge": "v0"}}])"});
  try {
    buildScenario(c);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("the same drive"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace gambeson
