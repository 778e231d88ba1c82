// Obstacles that are moved by programs.
#include <gtest/gtest.h>

#include <numbers>

#include "cases/contact/stage.hpp"
#include "cases/wear/case/case.hpp"
#include "unit/cases/malformed.hpp"

namespace gambeson {
namespace {

const std::string floor_line =
    R"({"name": "floor", "plane": {"point": [0, 0, "-1 cm"]}, "velocity": [0, 0, "1 mm/s"]})";

std::string driven(const std::string& drive) {
  return replaced(example, floor_line,
                  R"({"name": "floor", "sphere": {"radius": 0.1, "center": [0.5, 0, -1]}, "drive": )" + drive + "}");
}

TEST(Drive, AProgramIsIntegratedExactly) {
  DriveProgram<double> p{{1, 2, 4}, {0, 6, 2}};
  EXPECT_EQ(p.upTo(0.5), 0);
  EXPECT_DOUBLE_EQ(p.upTo(1.5), 0.5 * 0.5 * 3);
  EXPECT_DOUBLE_EQ(p.upTo(2), 3);
  EXPECT_DOUBLE_EQ(p.upTo(4), 3 + 8);
  EXPECT_DOUBLE_EQ(p.upTo(5), 3 + 8 + 2);
}

TEST(Drive, ABallGoesAndSpins) {
  const Folder folder;
  const Case c = readCase(folder.write(
      "case.json",
      driven(R"({"velocity": [[0, 0, 1, 0], [2, 0, 1, 0]], "spin": [[0, 0], [1, 2]], "center": [0, 0, -1]})")));
  ObstacleStage stage;
  stage.place(c.obstacles, makeObstacles(c.obstacles));
  std::vector<Placement> at(c.obstacles.size());
  stage.placements(2, at, {});
  const double angle = 1 + 2;  // rad: half of 2 rad/s in the first second, then all of it
  const Vec3 expected{0.5 * std::cos(angle), 0.5 * std::sin(angle) + 2, -1};
  EXPECT_LT(norm(at[1].origin - expected), 1e-14);
  EXPECT_LT(norm(at[1].rotation.a - Vec3{std::cos(angle), std::sin(angle), 0}), 1e-14);
  stage.placements(-1, at, {});
  EXPECT_EQ(at[1].origin, (Vec3{0.5, 0, -1})) << "it rests before its program starts";
  const std::string full = writeCase(c);
  EXPECT_EQ(writeCase(readCase(folder.write("again.json", full))), full);
}

TEST(Drive, SaysWhatIsWrong) {
  const std::string good = R"({"spin": [[0, 0], [1, 2]]})";
  const auto refused = [&](const std::string& drive, const std::string& key, const std::string& words) {
    expectRefused(driven(good), {{good, drive, 21, "obstacles[1].drive" + key, words}});
  };
  refused("{}", "", "gives neither velocity nor spin");
  refused(R"({"spin": [[0, 0], [0, 2]]})", ".spin[1]", "0 s does not come after 0 s");
  refused(R"({"spin": [[0, 0, 1]]})", ".spin[0]", "has 3 numbers; expected a time and 1 more");
  refused(R"({"velocity": [[0, 1]]})", ".velocity[0]", "expected a time and 3 more");
  refused(R"({"velocity": 3})", ".velocity", "expected a list of rows");
  refused(R"({"spin": [[0, 0]], "axis": [0, 0, 0]})", ".axis", "cannot have the length 0");
}

}  // namespace
}  // namespace gambeson
