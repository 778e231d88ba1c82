/// Readers of the public collision data (tests/tools/collision_data.hpp).
#include "tools/collision_data.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "core/error.hpp"

namespace gambeson::collision {
namespace {

namespace fs = std::filesystem;

class CollisionData : public ::testing::Test {
 protected:
  fs::path folder = fs::temp_directory_path() / ("gambeson_collision_data_" + std::to_string(getpid()));
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  fs::path file(const std::string& name, const std::string& content) const {
    std::ofstream(folder / name, std::ios::binary) << content;
    return folder / name;
  }
};

std::string rows(const std::string& row, int n) {
  std::string s;
  while (n-- > 0) s += row + "\n";
  return s;
}

TEST_F(CollisionData, QueriesAreRational) {
  const auto q = readQueries(file("a.csv", rows("-1,4,3,8388608,0,1,1", 8) + rows("1,3,0,1,0,1,0", 8)));
  ASSERT_EQ(q.size(), 2u);
  EXPECT_EQ(q[0].x0[0], (Vec3{-0.25, 3.0 / 8388608, 0}));
  EXPECT_EQ(q[0].truth, true);
  EXPECT_EQ(q[0].rounding, 0);
  // 1/3 is no double: the nearest is 1/3 - 2^-54 / 3.
  EXPECT_EQ(q[1].x1[3].x, 1.0 / 3);
  EXPECT_EQ(q[1].truth, false);
  EXPECT_NEAR(q[1].rounding, std::ldexp(1, -54) / 3, 1e-30);
  EXPECT_GT(q[1].rounding, std::ldexp(1, -54) / 3 * (1 - 1e-15));
  // 2/3 rounds up: truncation would be twice as far.
  EXPECT_EQ(readQueries(file("b.csv", rows("2,3,0,1,0,1", 8)))[0].x0[0].x, 2.0 / 3);
  EXPECT_FALSE(readQueries(folder / "b.csv")[0].truth.has_value());
}

TEST_F(CollisionData, WrongQueriesAreRejected) {
  EXPECT_THROW(readQueries(folder / "none.csv"), InputError);
  EXPECT_THROW(readQueries(file("a.csv", rows("0,1,0,1,0,1", 7))), InputError);
  EXPECT_THROW(readQueries(file("b.csv", rows("0,1,0,1,0", 8))), InputError);
  EXPECT_THROW(readQueries(file("c.csv", rows("0,0,0,1,0,1", 8))), InputError);
  EXPECT_THROW(readQueries(file("d.csv", rows("x,1,0,1,0,1", 8))), InputError);
  EXPECT_THROW(readQueries(file("e.csv", rows("0,1,0,1,0,1,1", 7) + "0,1,0,1,0,1,0\n")), InputError);
}

std::string bytes(auto value, bool big) {
  std::string s(reinterpret_cast<const char*>(&value), sizeof value);
  return big ? std::string(s.rbegin(), s.rend()) : s;
}

TEST_F(CollisionData, FramesOfAnyByteOrder) {
  const std::array<Vec3, 4> x{Vec3{0, 0, 0}, Vec3{1, 0, -0.5}, Vec3{0, 1, 0.25}, Vec3{1, 1, 3}};
  const std::string body =
      "element vertex 4\nproperty TYPE x\nproperty TYPE y\nproperty uchar other\nproperty TYPE z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  const auto header = [&](const std::string& format, const std::string& type) {
    std::string s = "ply\nformat " + format + " 1.0\ncomment x\n" + body;
    for (std::size_t at; (at = s.find("TYPE")) != std::string::npos;) s.replace(at, 4, type);
    return s;
  };
  std::vector<fs::path> files;
  for (bool big : {false, true}) {
    std::string s = header(big ? "binary_big_endian" : "binary_little_endian", big ? "float" : "double");
    for (const Vec3& v : x)
      for (int k : {0, 1, -1, 2}) {
        if (k < 0)
          s += '\7';
        else
          s += big ? bytes(static_cast<float>(v[k]), true) : bytes(v[k], false);
      }
    for (const auto& f : {std::array{0, 1, 2}, std::array{3, 2, 1}}) {
      s += '\3';
      for (int i : f) s += bytes(i, big);
    }
    files.push_back(file(big ? "big.ply" : "little.ply", s));
    file("short.ply", s.substr(0, s.size() - 1));
  }
  files.push_back(
      file("text.ply", header("ascii", "float") + "0 0 7 0\n1 0 7 -0.5\n0 1 7 0.25\n1 1 7 3\n3 0 1 2\n3 3 2 1\n"));
  for (const fs::path& f : files) {
    const Frame frame = readPly(f);
    ASSERT_EQ(frame.vertices.size(), 4u) << f;
    for (int i = 0; i < 4; ++i) EXPECT_EQ(frame.vertices[i], x[i]) << f;
    ASSERT_EQ(frame.faces.size(), 2u) << f;
    EXPECT_EQ(frame.faces[1], (std::array{3, 2, 1}));
  }
  EXPECT_THROW(readPly(folder / "short.ply"), InputError);
  EXPECT_THROW(
      readPly(file("quad.ply", header("ascii", "float") + "0 0 7 0\n1 0 7 0\n0 1 7 0\n1 1 7 3\n4 0 1 2 3\n3 3 2 1\n")),
      InputError);
  EXPECT_THROW(
      readPly(file("beyond.ply", header("ascii", "float") + "0 0 7 0\n1 0 7 0\n0 1 7 0\n1 1 7 3\n3 0 1 4\n3 3 2 1\n")),
      InputError);

  // Edges by their larger, then their smaller vertex: 01, 02, 12, 13, 23 have the ids 4 to 8, the faces 9 and 10.
  const Frame frame = readPly(files[0]);
  EXPECT_EQ(edgesOf(frame), (std::vector<std::array<int, 2>>{{0, 1}, {0, 2}, {1, 2}, {1, 3}, {2, 3}}));
  const auto ee = queriesOf(frame, frame, readPairs(file("ee.json", "[[5, 7]]")), PairKind::kEdgeEdge);
  EXPECT_EQ(ee[0].x0, (std::array{x[0], x[2], x[1], x[3]}));
  const auto vf = queriesOf(frame, frame, {{0, 10}}, PairKind::kPointTriangle);
  EXPECT_EQ(vf[0].x1, (std::array{x[0], x[3], x[2], x[1]}));
  EXPECT_THROW(queriesOf(frame, frame, {{5, 9}}, PairKind::kEdgeEdge), InputError);
  EXPECT_THROW(queriesOf(frame, frame, {{5, 9}}, PairKind::kPointTriangle), InputError);
}

TEST_F(CollisionData, KindsAndTruthByName) {
  EXPECT_EQ(kindOfPath("x/edge-edge/data_0_0.csv"), PairKind::kEdgeEdge);
  EXPECT_EQ(kindOfPath("x/vertex-face/data_0_0.csv"), PairKind::kPointTriangle);
  EXPECT_EQ(kindOfPath("227vf.json"), PairKind::kPointTriangle);
  EXPECT_EQ(kindOfPath("92ee.json"), PairKind::kEdgeEdge);
  EXPECT_THROW(kindOfPath("data.csv"), InputError);
  EXPECT_EQ(readTruth(file("t.json", "[true,false]")), (std::vector<bool>{true, false}));
  EXPECT_THROW(readTruth(file("u.json", "[1, 2]")), InputError);
  EXPECT_THROW(readPairs(file("v.json", "[1, 2")), InputError);
}

}  // namespace
}  // namespace gambeson::collision
