/// Bodies as snapshots of their surface: what cloth feels of them.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "cases/input/fingerprint.hpp"
#include "core/error.hpp"
#include "unit/cases/example.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

/// A block of 0.4 x 0.4 x 0.1 m, its top at height z.
std::string block(double z) {
  std::string out;
  for (int i = 0; i < 8; ++i)
    out += fmt::format("v {} {} {:.9f}\n", i & 1 ? 0.2 : -0.2, i & 2 ? 0.2 : -0.2, z - (i & 4 ? 0 : 0.1));
  for (const char* f : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"})
    out += fmt::format("f {}\n", f);
  return out;
}

// clang-format off
const std::string lifted = R"json({
  "name": "lifted",
  "garment": {"sheet": {"width": "0.2 m", "height": "0.2 m", "cells_u": 6, "cells_v": 6, "axis_u": [1, 0, 0], "axis_v": [0, 1, 0]},
              "position": ["-0.1 m", "-0.1 m", "1.2 mm"]},
  "fabric": {
    "thickness": "1 mm", "density": "1000 kg/m^3", "young": "0.5 MPa",
    "bending": {"law": "linear", "rigidity": "1e-4 N m"}
  },
  "obstacles": [{"name": "lift", "sequence": {"folder": "frames", "rate": "20 Hz", "begin": "-0.1 s"}}],
  "contact": {"friction": 0.3, "layer": "1 mm"},
  "time": {"duration": "0.6 s"}
})json";
// clang-format on

/// At rest until 0.1 s, then with an acceleration of 2 m/s^2 (Catmull-Rom cubics have parabolas exactly).
constexpr double rise_m_per_s2 = 2, from_s = 0.1;
void writeFrames(const Folder& folder, double rate_Hz) {
  std::filesystem::create_directory(folder.path() / "frames");
  for (int i = 0; i <= 20; ++i) {
    const double t = std::max(0.0, i / rate_Hz - 0.1 - from_s);
    folder.write(fmt::format("frames/block{}.obj", i), block(0.5 * rise_m_per_s2 * t * t));
  }
}

/// A sheet on a lift presses with m (g + a).
TEST(SequenceCase, CarriesClothThatItAccelerates) {
  const Folder folder;
  writeFrames(folder, 20);
  SceneRun scene(readCase(folder.write("case.json", lifted)));
  ASSERT_EQ(scene.scenario->bodies, std::vector<std::string>{"lift"});
  EXPECT_EQ(scene.scenario->body_of_obstacle, std::vector<int>{0});
  EXPECT_NE(scene.scenario->facts[0].find("obstacle lift (frames): 21 frames from -0.100 to 0.900 s, 12 triangles"),
            std::string::npos)
      << scene.scenario->facts[0];
  AuditWatch audit;
  Vec3 received{};
  double time = 0;
  scene.run(0.6, [&](const State&, const State& after, const StepReport& r, const StepResult& w, const Frequency&) {
    audit(r);
    if (after.time_s < 0.3) return;
    time += r.step_s;
    for (const ContactImpulse& c : w.contact_impulses) {
      EXPECT_EQ(c.obstacle, 0);
      received += c.impulse;
    }
  });
  const double mass = 0.04;  // 0.2 m x 0.2 m x 1 kg/m^2
  EXPECT_NEAR(received.z / time / (mass * (9.81 + rise_m_per_s2)), 1, 0.01);
  EXPECT_LT(std::hypot(received.x, received.y), 0.01 * received.z);
  EXPECT_LT(audit.worst, 1e-9);
}

TEST(SequenceCase, IsAnotherCaseWithOtherFrames) {
  const Folder folder;
  writeFrames(folder, 20);
  const auto file = folder.write("case.json", lifted);
  const std::string one = caseIdentity(readCase(file));
  EXPECT_EQ(caseIdentity(readCase(file)), one);
  folder.write("frames/block7.obj", block(0.01));
  EXPECT_NE(caseIdentity(readCase(file)), one);
}

TEST(SequenceCase, SaysWhatIsWrong) {
  const Folder folder;
  writeFrames(folder, 20);
  const auto refused = [&](const std::string& from, const std::string& to, const std::string& words) {
    try {
      readCase(folder.write("case.json", replaced(lifted, from, to)));
      ADD_FAILURE() << to << " was accepted; expected: " << words;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(words), std::string::npos) << e.what();
    }
  };
  refused("\"rate\": \"20 Hz\"", "\"rate\": 0", "obstacles[0].sequence.rate");
  refused("\"folder\": \"frames\",", "", "folder");
  refused("\"folder\": \"frames\"", "\"folder\": \"frame\"", "frame");
  refused("\"rate\": \"20 Hz\"", "\"up\": \"y\"", "forward: is missing");
  folder.write("frames/block3.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  refused("\"rate\": \"20 Hz\"", "\"rate\": \"21 Hz\"", "block3.obj: has 3 vertices and 1 triangles");
}

}  // namespace
}  // namespace gambeson
