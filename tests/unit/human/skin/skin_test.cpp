/// The skin at rest: a closed surface, and its weights.

#include "human/body/skin.hpp"
#include "human/skin/make_skin.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "core/contact/mesh_topology.hpp"
#include "core/error.hpp"
#include "human/files/mesh.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "unit/human/files/files.hpp"

namespace gambeson {
namespace {

const Human& human() {
  static const Human h = makeManikin("male_p50");
  return h;
}
const Skin& skin() {
  static const Skin s = makeSkin(human());
  return s;
}

TEST(Skin, IsClosedAndOfOnePieceWithoutHandles) {
  const MeshTopology m = meshTopology(skin().rest);
  EXPECT_TRUE(m.closed);
  EXPECT_EQ(meshDefects(m), "");
  const auto count = [](const auto& list) { return static_cast<long>(list.size()); };
  EXPECT_EQ(count(skin().rest.vertices) - count(m.edges) + count(skin().rest.triangles), 2);  // Euler: a sphere
  EXPECT_GE(count(skin().rest.triangles), 20000);
}

TEST(Skin, WeightsSumToOneAndLinksAscend) {
  const Skin& s = skin();
  ASSERT_EQ(s.first.size(), s.rest.vertices.size() + 1);
  for (std::size_t v = 0; v < s.rest.vertices.size(); ++v) {
    double sum = 0;
    for (int i = s.first[v]; i < s.first[v + 1]; ++i) {
      sum += s.weight[i];
      EXPECT_GT(s.weight[i], 0);
      EXPECT_TRUE(i == s.first[v] || s.link[i] > s.link[i - 1]);
    }
    EXPECT_NEAR(sum, 1, 1e-14);
  }
}

TEST(Skin, StaysAtRestInTheBindPostureAndMovesWithTheRoot) {
  const Skin& s = skin();
  std::vector<Vec3> x(s.rest.vertices.size());
  skinPositions(s, s.bind, x);
  for (std::size_t v = 0; v < x.size(); ++v) EXPECT_LT(norm(x[v] - s.rest.vertices[v]), 1e-14);
  Posture p = standing(human());
  const Pose X{rotationAbout({0.6, 0, 0.8}, 0.7), {0.3, -0.2, 0.1}};
  p.root = X * p.root;
  skinPositions(s, linkPoses(human().skeleton, p.q, p.root), x);
  for (std::size_t v = 0; v < x.size(); ++v) EXPECT_LT(norm(x[v] - X * s.rest.vertices[v]), 1e-14);
}

/// A skin from a file has weights only: x = sum of w_l X_l X_l,bind⁻¹ x0, so a vertex halfway between two links that
/// moved by a and b moves by (a + b)/2.
TEST(Skin, BlendsLinearlyWithoutBends) {
  Skin s;
  s.rest.vertices = {{1, 2, 3}, {1, 2, 3}};
  s.bind = {Pose{{}, {0, 0, 1}}, Pose{{}, {0, 0, 2}}};
  s.first = {0, 1, 3};
  s.link = {0, 0, 1};
  s.weight = {1, 0.5, 0.5};
  std::vector<Vec3> x(2);
  skinPositions(s, std::vector<Pose>{Pose{{}, {0.2, 0, 1}}, Pose{{}, {0, 0.4, 2}}}, x);
  EXPECT_LT(norm(x[0] - Vec3{1.2, 2, 3}), 1e-15);
  EXPECT_LT(norm(x[1] - Vec3{1.1, 2.2, 3}), 1e-15);
}

TEST(Skin, ReadsBackFromItsFile) {
  const test::Folder folder;
  writeMesh(skin().rest, folder.path / "skin.obj");
  const TriangleMesh m = loadMesh(folder.path / "skin.obj");
  ASSERT_EQ(m.triangles.size(), skin().rest.triangles.size());
  for (std::size_t t = 0; t < m.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)  // the reader's numbers are single precision
      ASSERT_LT(norm(m.vertices[m.triangles[t][k]] - skin().rest.vertices[skin().rest.triangles[t][k]]), 1e-6);
  EXPECT_THROW(writeMesh(skin().rest, folder.path / "none" / "skin.obj"), InputError);
}

TEST(Skin, RefusesOptionsAndBodiesThatItCannotServe) {
  EXPECT_NO_THROW(makeSkin(human(), {.cell_m = 0.05}));  // as coarse as the body of Zheng 2013, section 3.7.4
  EXPECT_THROW(makeSkin(human(), {.cell_m = 0.051}), InputError);
  EXPECT_THROW(makeSkin(human(), {.cell_m = 0}), InputError);
  EXPECT_THROW(makeSkin(human(), {.cell_m = std::nan("")}), InputError);
  EXPECT_THROW(makeSkin(human(), {.crease_gap_m = -1e-3}), InputError);
  Human headless = human();
  std::erase_if(headless.shapes, [](const BodyShape& s) { return s.name == "head"; });
  EXPECT_THROW(makeSkin(headless), InputError);
  std::vector<Vec3> few(3);
  EXPECT_THROW(skinPositions(skin(), skin().bind, few), RunError);
}

}  // namespace
}  // namespace gambeson
