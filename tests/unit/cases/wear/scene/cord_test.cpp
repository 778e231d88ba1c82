/// Cords that draw an edge together.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "cases/wear/run/run.hpp"
#include "cases/wear/scene/supports.hpp"
#include "core/motion/stitch.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/malformed.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

/// A ring of cloth so soft that its cord alone counts, 2 mm off a ball about its equator, in no gravity.
const std::string ring = R"json({
  "name": "ring", "gravity": [0, 0, 0],
  "garment": {"tube": {"radius": "10.3 cm", "length": "2 cm", "cells_around": 48, "cells_along": 2, "start": [0, 0, 0], "axis": [0, 0, 1]}},
  "fabric": {"thickness": "1 mm", "density": 400, "young": "2 kPa", "poisson": 0,
             "bending": {"law": "linear", "rigidity": "1e-7 N m", "rest": "shape"}},
  "obstacles": [{"name": "ball", "sphere": {"radius": "10 cm"}}],
  "supports": [{"cord": {"edge": "start", "tension": "5 N", "from": "0.05 s", "draw": "0.1 s"}}],
  "contact": {"friction": 0.3},
  "air": {"drag": "20 kg/(m^2 s)"},
  "time": {"duration": 0.3},
  "output": {"window": "10 ms", "frame": "100 ms", "checkpoint": "100 ms", "pictures": []}
})json";

// A cord without a length of its own: what it stores is 1/2 T L where it is as long as at rest, with the tension T in
// each of its parts.
TEST(Cord, PullsWithItsTension) {
  const Folder folder;
  const auto s = buildScenario(readCase(folder.write("case.json", ring)));
  Model& m = *s->model;
  const double length = 2 * std::numbers::pi * 0.103;
  StepWork work;
  const State rest = startOf(*s, work);
  EXPECT_EQ(stitchEnergy(m.stitches, m.surface.WT, rest.p), 0);  // slack yet
  EXPECT_TRUE(drawCords(s->definition, 1, s->supports, m));
  EXPECT_FALSE(drawCords(s->definition, 2, s->supports, m));
  const double stored = stitchEnergy(m.stitches, m.surface.WT, rest.p);
  EXPECT_NEAR(stored, 0.5 * 5 * length, 1e-3 * stored);
  std::vector<Vec3> x;
  samplePositions(m, rest.p, x);
  for (const Stitch& part : m.stitches) EXPECT_NEAR(part.stiffness_N_per_m * norm(x[part.b] - x[part.a]), 5, 1e-9);
  EXPECT_TRUE(drawCords(s->definition, 0.1, s->supports, m));  // half of the way
  EXPECT_NEAR(stitchEnergy(m.stitches, m.surface.WT, rest.p), 0.5 * stored, 1e-9);
  EXPECT_TRUE(drawCords(s->definition, 0.05, s->supports, m));
  EXPECT_EQ(stitchEnergy(m.stitches, m.surface.WT, rest.p), 0);
}

// On a round body of radius r the cord presses with its tension over r for each length, 2 pi times the tension in all,
// and the tension has fallen with the length, from 10.3 to 10.1 cm.
TEST(Cord, PressesAsACordAroundABodyDoes) {
  const Folder folder;
  SceneRun scene(readCase(folder.write("case.json", ring), {R"(supports[0].cord.from=-1)"}));
  double pressed_Ns = 0;
  const double from = 0.2;
  const auto watch = [&](const State&, const State& after, const StepReport&, const StepResult& w, const Frequency&) {
    if (after.time_s <= from + 1e-12) return;
    std::vector<Vec3> x;
    samplePositions(scene.model, after.p, x);
    for (const ContactImpulse& i : w.contact_impulses) {
      const Vec3 outward = normalized(Vec3{x[i.sample].x, x[i.sample].y, 0});
      pressed_Ns += dot(i.impulse, outward);
    }
  };
  scene.run(from, watch);
  scene.run(0.3, watch);
  std::vector<Vec3> x;
  samplePositions(scene.model, scene.state.p, x);
  double length = 0;
  for (const Stitch& part : scene.model.stitches) length += norm(x[part.b] - x[part.a]);
  EXPECT_NEAR(length, 2 * std::numbers::pi * 0.101, 2e-3);
  const double tension = 5 * length / (2 * std::numbers::pi * 0.103);
  EXPECT_NEAR(std::abs(pressed_Ns) / 0.1, 2 * std::numbers::pi * tension, 0.03 * 2 * std::numbers::pi * tension);
}

TEST(Cord, IsDrawnWindowByWindow) {
  const Folder folder;
  // Half of the step that the cord's frequency allows, at which Verlet's energy is off by 3 % (at 0.1 ms by 0.4 %).
  const Case c = readCase(folder.write("case.json", ring), {R"(time.max_step="0.2 ms")"});
  ASSERT_EQ(runCase(c, {folder.path() / "out", 1, false}), 0);
  const auto j = nlohmann::json::parse(content(folder.path() / "out/summary.json"));
  EXPECT_LT(j.at("momentum").at("largest_error_ratio").get<double>(), 1e-9);
  EXPECT_LT(std::abs(j.at("energy").at("drift_ratio").get<double>()), 0.02);
  EXPECT_GT(j.at("energy").at("work_supports_J").get<double>(), 0.5);  // 1/2 T L, less what it has shortened
  EXPECT_TRUE(j.at("supports").empty());
}

TEST(Cord, BadNumbersAreRefused) {
  const Folder folder;
  const auto refused = [&](const std::string& set, const std::string& key) {
    try {
      readCase(folder.write("case.json", ring), {set});
      ADD_FAILURE() << "accepted: " << set;
    } catch (const InputError& e) {
      EXPECT_NE(e.where().key.find(key), std::string::npos) << e.what();
    }
  };
  refused("supports[0].cord.tension=0", "tension");
  refused("supports[0].cord.draw=0", "draw");
  refused("supports[0].cord.from=-100", "from");
  refused("supports[0].cord.edge=\"waist\"", "edge");
  refused("time.scheme=\"rk4\"", "time.scheme");
}

}  // namespace
}  // namespace gambeson
