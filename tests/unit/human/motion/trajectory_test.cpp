#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/trajectory.hpp"
#include "unit/human/files/files.hpp"

namespace gambeson {
namespace {

using test::expectRefused;
using test::Folder;

const std::string rows = "time_s,knee_flexion_right_deg,root_x_m\n0,0,0\n0.5,30,0.1\n1,90,0.1\n2,60,-0.1\n";

class Trajectory : public testing::Test {
 protected:
  Human human = makeManikin("male_p50");
  Folder folder;
  std::unique_ptr<Motion> load(const std::string& text) { return loadTrajectory(folder.write("t.csv", text), human); }
  void refused(const std::string& text, int line, const char* words) {
    expectRefused([&](const auto& f) { loadTrajectory(f, human); }, folder.write("t.csv", text), line, words);
  }
};

TEST_F(Trajectory, GoesThroughItsRowsInTheirUnits) {
  const auto m = load(rows);
  const int knee = human.skeleton.joint("knee_flexion_right"), hip = human.skeleton.joint("hip_adduction_left");
  EXPECT_EQ(m->duration(), 2);
  const std::array<std::array<double, 3>, 4> table{{{0, 0, 0}, {0.5, 30, 0.1}, {1, 90, 0.1}, {2, 60, -0.1}}};
  for (const auto& [t, deg, x] : table) {
    EXPECT_NEAR(m->at(t).q[knee], deg * rad_per_deg, 1e-12);
    EXPECT_NEAR(m->at(t).root.origin.x, x, 1e-12);
  }
  EXPECT_EQ(m->at(0.7).q[hip], standing(human).q[hip]);  // what no column names stays as in standing
  EXPECT_EQ(m->at(0.7).root.origin.z, standing(human).root.origin.z);
  EXPECT_EQ(m->at(-1).q, m->at(0).q);
  EXPECT_EQ(m->at(9).q, m->at(2).q);
}

TEST_F(Trajectory, IsMonotoneBetweenRowsWithContinuousVelocity) {
  const auto m = load(rows);
  const int knee = human.skeleton.joint("knee_flexion_right");
  const double h = 1e-6;
  for (int i = 1; i < 2000; ++i) {
    const double t = i / 1000.0, q = m->at(t).q[knee];
    const double left = (q - m->at(t - h).q[knee]) / h, right = (m->at(t + h).q[knee] - q) / h;
    EXPECT_NEAR(left, right, 1e-4);
    EXPECT_GE(right * (t < 1 ? 1 : -1), -1e-6) << t;
  }
}

TEST_F(Trajectory, ReproducesAStraightLineAndConverges) {
  const auto line = load("time_s,root_y_m\n0,0\n0.1,0.2\n0.7,1.4\n1,2\n");
  for (int i = 0; i <= 10; ++i) EXPECT_NEAR(line->at(i / 10.0).root.origin.y, 0.2 * i, 1e-12);
  // Away from extrema the monotone cubic converges with at least the third order (Fritsch and Butland 1984).
  const auto error = [&](int n) {
    std::string text = "time_s,root_y_m\n";
    for (int i = 0; i <= n; ++i)
      text += std::to_string(1.0 * i / n) + "," + std::to_string(std::exp(1.0 * i / n)) + "\n";
    const auto m = load(text);
    double e = 0;
    for (int i = 0; i < 500; ++i) e = std::max(e, std::abs(m->at(i / 500.0).root.origin.y - std::exp(i / 500.0)));
    return e;
  };
  EXPECT_GT(std::log2(error(5) / error(10)), 2.5);
}

TEST_F(Trajectory, RootTurnsByRollPitchYaw) {
  const auto m = load("time_s,root_roll_rad,root_pitch_deg,root_yaw_rad\n0,0.1,0,0.3\n1,0.1,20,0.3\n");
  const Mat3 expected =
      rotationAbout({0, 0, 1}, 0.3) * rotationAbout({0, 1, 0}, std::numbers::pi / 9) * rotationAbout({1, 0, 0}, 0.1);
  EXPECT_LT(norm(m->at(1).root.rotation.a - expected.a), 1e-14);
  EXPECT_LT(norm(m->at(1).root.rotation.c - expected.c), 1e-14);
}

TEST_F(Trajectory, ReadsWindowsLineEndsAndBlanks) {
  EXPECT_EQ(load("time_s, root_x_m\r\n0, 0\r\n1, +1e0\r\n\r\n")->at(1).root.origin.x, 1);
}

TEST_F(Trajectory, RefusesWhatIsMalformed) {
  // syntax
  refused("time_s,root_x_m\n0,0\n1,one\n", 3, "'one' is not a finite number");
  refused("time_s,root_x_m\n0,0\n1,1,1\n", 3, "has 3 values");
  refused("time_s,root_x_m\n0;0\n1;1\n", 2, "has 1 values");
  refused("time_s,root_x_m\n0,0x10\n1,1\n", 2, "0x10");
  refused(std::string("time_s,root_x_m\n0,\0\n1,1\n", 24), 0, "zero byte");
  // units
  refused("time_s,knee_flexion_right\n0,0\n1,0\n", 1, "");
  refused("time_s,knee_flexion_right_grad\n0,0\n1,0\n", 1, "unit");
  refused("time_s,knee_flexion_right_m\n0,0\n1,0\n", 1, "the joint turns");
  refused("time_s,root_x_deg\n0,0\n1,0\n", 1, "is a length");
  refused("time_ms,root_x_m\n0,0\n1,0\n", 1, "time_s");
  refused("time_s,root_x_m\n0,0\n1,1m\n", 3, "1m");
  // range
  refused("time_s,knee_flexion_right_deg\n0,0\n1,141\n", 3, "outside 0 to 140");
  refused("time_s,knee_flexion_right_deg\n0,-1\n1,12\n", 2, "outside");
  refused("time_s,root_x_m\n0,0\n1,0\n1,0\n", 4, "does not come after");
  refused("time_s,root_x_m\n0,0\n2,0\n1,0\n", 4, "does not come after");
  refused("time_s,root_x_m\n0,0\n1e-320,1\n1,0\n", 3, "comes less than 1e-09 s after 0");
  refused("time_s,root_x_m\n1,0\n2,0\n", 2, "not at 0");
  refused("time_s,root_x_m\n-1,0\n2,0\n", 2, "not at 0");
  // NaN
  refused("time_s,root_x_m\n0,nan\n1,0\n", 2, "column 2 'root_x_m'");
  refused("time_s,root_x_m\n0,0\nnan,0\n", 3, "time_s");
  refused("time_s,root_x_m\n0,inf\n1,0\n", 2, "inf");
  refused("time_s,root_x_m\n0,0\n1,1e999\n", 3, "1e999");
  // missing
  refused("time_s,root_x_m\n0,\n1,0\n", 2, "''");
  refused("time_s,root_x_m\n0,0\n1\n", 3, "has 1 values");
  refused("time_s,root_x_m\n0,0\n", 0, "two rows");
  refused("time_s\n0\n1\n", 1, "names no joint");
  refused("0,0\n1,1\n", 1, "time_s");
  refused("time_s,root_x_m\n0,0\n\n1,0\n", 3, "blank");
  // unknown, twice
  refused("time_s,tail_deg\n0,0\n1,0\n", 1, "no joint 'tail'");
  refused("time_s,wrist_left_deg\n0,0\n1,0\n", 1, "fixed");
  refused("time_s,root_x_m,root_x_m\n0,0,0\n1,0,0\n", 1, "twice");
  refused("time_s,knee_flexion_right_deg,knee_flexion_right_rad\n0,0,0\n1,0,0\n", 1, "twice");
  refused("time_s,\n0,0\n1,0\n", 1, "no name");
  // truncated, empty
  refused(rows.substr(0, 20), 1, "");
  refused(rows.substr(0, rows.size() - 6), 5, "has");
  refused("", 0, "empty");
  refused("\n\n", 0, "");
  refused("time_s,root_x_m\n", 0, "two rows");
  // enormous
  refused("time_s,root_x_m\n0,0\n1,1e9\n", 3, "outside");
  refused("time_s,root_yaw_rad\n0,0\n1,1e9\n", 3, "outside");
  refused("time_s,root_x_m\n0,0\n1e300,0\n", 3, "beyond");
  refused("time_s," + std::string(1000000, 'x') + "_m\n0,0\n1,0\n", 1, "no joint");
  // unreadable
  expectRefused([&](const auto& f) { loadTrajectory(f, human); }, folder.path / "none.csv", 0, "no such file");
  expectRefused([&](const auto& f) { loadTrajectory(f, human); }, folder.path, 0, "folder");
  expectRefused([&](const auto& f) { loadTrajectory(f, human); }, "/dev/null", 0, "regular");
  expectRefused([&](const auto& f) { loadTrajectory(f, human); }, "/dev/zero", 0, "regular");
}

TEST_F(Trajectory, RefusesAJointThatFollowsAnother) {
  human.skeleton.joints[human.skeleton.joint("knee_flexion_left")].mimic_of = 0;
  refused("time_s,knee_flexion_left_deg\n0,0\n1,0\n", 1, "follows");
}

}  // namespace
}  // namespace gambeson
