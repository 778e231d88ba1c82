/// A body of segments between markers, as a case has it (Man 2006, 5.1).

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "human/body/segment_ellipsoid.hpp"
#include "unit/cases/wear/scene/scene.hpp"

namespace gambeson {
namespace {

/// Where an arm's markers are at a time: its joints and one above it, swinging about the shoulder (y is up, in mm).
std::array<Vec3, 3> arm(double t) {
  const double c = std::cos(t), s = std::sin(t);
  return {Vec3{0, 1, 0}, Vec3{0.3 * c, 1 - 0.3 * s, 0}, Vec3{0.15 * c + 0.05 * s, 1 - 0.15 * s + 0.05 * c, 0}};
}

std::filesystem::path markerFile() {
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "arm.trc";
  std::ofstream out(file);
  out << "PathFileType\t4\t(X/Y/Z)\tarm.trc\n"
         "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n"
         "100\t100\t101\t3\tmm\t100\t1\t101\n"
         "Frame#\tTime\tshoulder\t\t\telbow\t\t\tside\t\t\t\n"
         "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3\n\n";
  out.precision(12);
  for (int i = 0; i <= 100; ++i) {
    out << i + 1 << '\t' << 0.01 * i;
    for (const Vec3& p : arm(0.01 * i)) out << '\t' << 1e3 * p.x << '\t' << 1e3 * p.y << '\t' << 1e3 * p.z;
    out << '\n';
  }
  return file;
}

Case markerCase(const std::vector<std::string>& more = {}) {
  std::vector<std::string> set{
      R"(human={"segments": [{"name": "arm", "upper_joint": ["shoulder"], "lower_joint": ["elbow"], "marker": ["side"],
          "semi_axes": ["20 cm", "5 cm", "4 cm"]}],
          "motion": {"markers": {"path": ")" +
          markerFile().string() + R"(", "up": "y", "from": 0.2, "to": 0.8}}})",
      R"(analysis={"joints": ["arm_pitch"]})"};
  set.insert(set.end(), more.begin(), more.end());
  return libraryCase("sleeve_flex", set);
}

// The ellipsoid stands where the markers of the window say, in our axes.
TEST(MarkersScene, SegmentsStandBetweenTheirMarkers) {
  const auto s = buildScenario(markerCase());
  EXPECT_NEAR(s->motion->duration(), 0.6, 1e-9);
  for (const double t : {0.0, 0.1, 0.6}) {
    std::array<Vec3, 3> p = arm(0.2 + t);
    for (Vec3& q : p) q = {q.x, -q.z, q.y};
    const Pose X = segmentPose(p[0], p[1], p[2], "arm");
    const Placement at = s->obstaclePlacements(t).front();
    EXPECT_LT(norm(at.origin - X.origin), 1e-9) << t;
    EXPECT_LT(norm(at.rotation.a - X.rotation.a) + norm(at.rotation.b - X.rotation.b), 1e-9) << t;
  }
}

// What is written of the case has them, and that of another case has no such key.
TEST(MarkersScene, AreWrittenOnlyWhereTheyAre) {
  const std::string written = writeCase(markerCase());
  EXPECT_NE(written.find("\"segments\""), std::string::npos);
  EXPECT_NE(written.find("\"shoulder\""), std::string::npos);
  EXPECT_EQ(writeCase(libraryCase("sleeve_flex")).find("\"segments\""), std::string::npos);
}

TEST(MarkersScene, NamesWhatIsWrong) {
  const auto keyOf = [](const std::string& set) -> std::string {
    try {
      buildScenario(markerCase({set}));
    } catch (const InputError& e) {
      return e.where().key;
    }
    return "nothing";
  };
  EXPECT_EQ(keyOf("human.motion.markers.up=\"x\""), "human.motion.markers.up");
  EXPECT_EQ(keyOf("human.motion.markers.forward=\"q\""), "human.motion.markers.forward");
  EXPECT_EQ(keyOf("human.motion.markers.to=0.1"), "human.motion.markers.to");
  EXPECT_EQ(keyOf("human.segments[0].semi_axes=[0.2, 0, 0.1]"), "human.segments[0].semi_axes[1]");
  EXPECT_EQ(keyOf("analysis.joints=[\"elbow_flexion\"]"), "analysis.joints[0]");
}

}  // namespace
}  // namespace gambeson
