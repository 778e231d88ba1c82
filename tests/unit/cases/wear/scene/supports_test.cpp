/// Forces of what holds a garment: each support its own, and together those of the momentum balance.

#include "cases/wear/scene/supports.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "cases/wear/run/run.hpp"
#include "unit/cases/content.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

/// A strip along x that hangs between its short edges, of which the left one is held in two rows.
const std::string strip = R"json({
  "name": "strip",
  "garment": {"sheet": {"width": 1.0, "height": 0.06, "cells_u": 10, "cells_v": 1, "corner": [0, 0, 0]}},
  "fabric": {"thickness": "1 mm", "surface_density": 0.3, "young": 20000, "poisson": 0,
             "bending": {"law": "linear", "rigidity": 1e-8}},
  "supports": [{"fixed": {"edge": "u0"}}, {"fixed": {"edge": "0.u1"}}],
  "air": {"drag": 1.5},
  "time": {"duration": 1.5},
  "output": {"frame": "100 ms", "pictures": []}
})json";

/// Two ends of the same strip pull against each other and carry half of its weight each.
TEST(Supports, EachHeldEdgeShowsItsOwnForce) {
  const Folder folder;
  const Case c = readCase(folder.write("case.json", strip));
  ASSERT_EQ(runCase(c, {folder.path() / "out", 1, false}), 0);
  const auto rows = nlohmann::json::parse(content(folder.path() / "out/summary.json")).at("supports");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].at("support"), "u0 held");
  EXPECT_EQ(rows[1].at("support"), "edge u1 of patch 0 held");
  const auto force = [&](int k) {
    const auto& f = rows[static_cast<std::size_t>(k)].at("mean_on_cloth_N");
    return Vec3{f[0].get<double>(), f[1].get<double>(), f[2].get<double>()};
  };
  const Vec3 left = force(0), right = force(1);
  const double weight = 0.3 * 0.06 * 9.81;
  EXPECT_LT(left.x, -0.1 * weight);
  EXPECT_NEAR(left.x, -right.x, 1e-9 * weight);
  EXPECT_NEAR(left.z, right.z, 1e-9 * weight);
  EXPECT_NEAR(left.z + right.z, weight, 0.1 * weight);
}

struct Sums {
  double worst = 0;  ///< of the sum over the supports against the audit's, relative to the audit's scale
  double contact = 0;
};

Sums sumsOf(const std::string& text, const std::vector<std::string>& overrides) {
  const Folder folder;
  SceneRun scene(readCase(folder.write("case.json", text), overrides));
  const Model& m = scene.model;
  Sums sums;
  scene.run(0.2, [&](const State&, const State&, const StepReport& r, const StepResult& w, const Frequency&) {
    Vec3 all{};
    for (const SupportGroup& g : scene.scenario->supports)
      for (const auto& [k, part] : g.held) all += part * w.held_impulses[static_cast<std::size_t>(k)];
    // The audit is that of the free points: what held points weigh, and the wind on them, comes on top.
    const Vec3 air = scene.stage.air(0);
    for (int i : m.held_points)
      all += r.step_s * (m.mass_kg[i] * m.environment.gravity_m_per_s2 + m.drag_kg_per_s[i] * air);
    sums.worst = std::max(sums.worst, norm(all - r.momentum.supports) / r.momentum.scale);
    sums.contact += norm(r.momentum.obstacles);
    return true;
  });
  return sums;
}

TEST(Supports, TogetherTheyGiveWhatTheMomentumBalanceSays) {
  const std::string corner = R"(supports=[{"fixed": {"edge": "u0", "rows": 2}}, {"fixed": {"edge": "v0"}}])",
                    point = R"(supports=[{"fixed": {"edge": "u0"}}, {"pinned": {"s": 0.75, "t": 0.5}}])",
                    floor =
                        R"(obstacles=[{"name": "floor", "plane": {"point": [0, 0, -0.0005], "normal": [0, 0, 1]}}])";
  EXPECT_LT(sumsOf(strip, {corner, "air.velocity=[1,2,3]"}).worst, 1e-12);
  EXPECT_LT(sumsOf(strip, {point}).worst, 1e-12);
  EXPECT_LT(sumsOf(strip, {R"(strain_limit={"mode":"upper_limit","limit":0.001})"}).worst, 1e-12);
  const Sums on_floor = sumsOf(strip, {floor, R"(contact={"friction":0.2,"layer":"1 mm"})"});
  EXPECT_GT(on_floor.contact, 0);
  EXPECT_LT(on_floor.worst, 1e-12);
}

}  // namespace
}  // namespace gambeson
