/// Scenes read back from .glb and OBJ as a player shows them.

#include "analysis/animation/glb.hpp"

#include <gtest/gtest.h>

#include <random>
#include <sstream>

#include "analysis/animation/obj.hpp"
#include "analysis/render/colormap.hpp"
#include "core/error.hpp"
#include "unit/analysis/animation/glb_reader.hpp"

namespace gambeson {
namespace {

/// Two nodes that turn and go, a mesh on the second, a skin over both, and cloth of a metre that goes three metres.
AnimatedScene example() {
  std::mt19937 rng(11);
  std::uniform_real_distribution<double> of(-1, 1);
  AnimatedScene s;
  s.title = "example";
  s.time_s = {0.5, 0.51, 0.53, 0.6};
  MovedNode root{"root", -1, {}}, arm{"arm", 0, {}};
  for (std::size_t k = 0; k < 4; ++k) {
    const double t = static_cast<double>(k);
    root.at.push_back({rotationAbout(normalized(Vec3{1, 2, -1}), 1.3 * t), {t, -0.2 * t, 1}, 1});
    arm.at.push_back({rotationAbout({0, 0, 1}, -0.9 * t), {0.3, 0, 0}, 1});
  }
  s.nodes = {root, arm, {"stone", -1, {{Mat3{}, Vec3{0, 4, 0}, 2}}}};
  RenderMesh mesh;
  for (int v = 0; v < 4; ++v) mesh.vertices.push_back({of(rng), of(rng), of(rng)});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  s.fixed = {{"hand", 1, mesh}, {"pebble", 2, mesh}};
  SkinnedMesh skin{"skin", mesh.vertices, mesh.triangles, {0, 1}, {Pose{}, Pose{Mat3{}, {-0.3, 0, 0}}}, {}, {}};
  for (int v = 0; v < 4; ++v) {
    const float w = 0.25f * static_cast<float>(v);
    skin.weights.push_back({std::pair{0, 1 - w}, {1, w}, {0, 0.f}, {0, 0.f}});
  }
  s.skinned = {skin};
  MovingMesh cloth{"shirt", {{0, 1, 2}, {2, 1, 3}}, {}, {}, {}};
  for (std::size_t k = 0; k < 4; ++k) {
    std::vector<float>& x = cloth.at.emplace_back();
    for (int v = 0; v < 4; ++v)
      for (int c = 0; c < 3; ++c)
        x.push_back(static_cast<float>(0.5 * of(rng) + (c == 0 ? static_cast<double>(k) : 0)));
  }
  cloth.colors = {{0, 0, 0}, {1, 1, 1}, {0.5f, 0.25f, 0.75f}, {0.2f, 0.4f, 0.6f}};
  s.moving = {cloth};
  return s;
}

TEST(Glb, NodesAndMeshesAreWhereTheSceneHasThemAtEachTime) {
  const AnimatedScene scene = example();
  const Glb glb = encodeGlb(scene);
  const GlbReader file(glb.bytes);
  const std::vector<double> times = file.times();
  ASSERT_EQ(times.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(times[k], scene.time_s[k] - 0.5, 1e-7);
    const std::vector<Placement> X_WN = worldOf(scene, k);
    for (std::size_t n = 0; n < 3; ++n)
      for (const Vec3& p : {Vec3{}, Vec3{1, 0, 0}, Vec3{0, 1, 0}})
        EXPECT_LT(norm(file.inOurs(file.node(scene.nodes[n].name), k, p) - X_WN[n] * p), 1e-6);
    for (const FixedMesh& m : scene.fixed) {
      const std::vector<Vec3> x = file.vertices(file.node(m.name), k);
      for (std::size_t v = 0; v < x.size(); ++v)
        EXPECT_LT(norm(x[v] - X_WN[static_cast<std::size_t>(m.node)] * m.mesh.vertices[v]), 2e-6);
    }
  }
  // Facing z with y up, as glTF has it.
  EXPECT_LT(norm(file.inWorld(0, 0, {1, 0, 0}) - Vec3{0, 0, 1}), 1e-12);
  EXPECT_LT(norm(file.inWorld(0, 0, {0, 0, 1}) - Vec3{0, 1, 0}), 1e-12);
}

TEST(Glb, ClothIsWithinTheErrorThatIsStated) {
  const AnimatedScene scene = example();
  const Glb glb = encodeGlb(scene);
  EXPECT_LT(glb.error_m, 0.5 * std::sqrt(3) * 2 / 32766);  // changes of up to 2 m
  EXPECT_GT(glb.error_m, 1e-7);
  const GlbReader file(glb.bytes);
  double most = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::vector<Vec3> x = file.vertices(file.node("shirt"), k);
    ASSERT_EQ(x.size(), 4u);
    for (std::size_t v = 0; v < 4; ++v) {
      const std::vector<float>& of = scene.moving[0].at[k];
      most = std::max(most, norm(x[v] - Vec3{of[3 * v], of[3 * v + 1], of[3 * v + 2]}));
    }
  }
  EXPECT_NEAR(most, glb.error_m, 1e-6);
}

TEST(Glb, TheSkinHangsOnItsNodes) {
  const AnimatedScene scene = example();
  const GlbReader file(encodeGlb(scene).bytes);
  const auto& primitive =
      file.json["meshes"][file.json["nodes"][static_cast<std::size_t>(file.node("skin"))]["mesh"].get<std::size_t>()]
               ["primitives"][0];
  const std::vector<double> rest = file.numbers(primitive["attributes"]["POSITION"]),
                            joint = file.numbers(primitive["attributes"]["JOINTS_0"]),
                            weight = file.numbers(primitive["attributes"]["WEIGHTS_0"]),
                            matrix = file.numbers(file.json["skins"][0]["inverseBindMatrices"]);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::vector<Vec3> expected = positionsOf(scene.skinned[0], worldOf(scene, k));
    for (std::size_t v = 0; v < 4; ++v) {
      Vec3 x;
      for (std::size_t i = 4 * v; i < 4 * v + 4; ++i) {
        const auto j = static_cast<std::size_t>(joint[i]);
        const double* m = matrix.data() + 16 * j;
        Vec3 p;
        for (int c = 0; c < 3; ++c)
          p[c] = m[c] * rest[3 * v] + m[4 + c] * rest[3 * v + 1] + m[8 + c] * rest[3 * v + 2] + m[12 + c];
        x += weight[i] * file.inOurs(file.json["skins"][0]["joints"][j], k, p);
      }
      EXPECT_LT(norm(x - expected[v]), 1e-6);
    }
  }
}

TEST(Glb, ColoursAreLinear) {
  const AnimatedScene scene = example();
  const GlbReader file(encodeGlb(scene).bytes);
  const auto& mesh =
      file.json["meshes"][file.json["nodes"][static_cast<std::size_t>(file.node("shirt"))]["mesh"].get<std::size_t>()];
  const std::vector<double> colors = file.numbers(mesh["primitives"][0]["attributes"]["COLOR_0"]);
  for (std::size_t v = 0; v < 4; ++v) {
    EXPECT_NEAR(colors[4 * v], linearOfSrgb(scene.moving[0].colors[v].r), 1e-5);
    EXPECT_NEAR(colors[4 * v + 2], linearOfSrgb(scene.moving[0].colors[v].b), 1e-5);
    EXPECT_EQ(colors[4 * v + 3], 1);
  }
}

TEST(Glb, OneTimeIsAPictureThatStands) {
  AnimatedScene scene = example();
  scene.time_s = {2};
  for (MovedNode& n : scene.nodes) n.at.resize(1);
  scene.moving[0].at.resize(1);
  const GlbReader file(encodeGlb(scene).bytes);
  EXPECT_FALSE(file.json.contains("animations"));
  EXPECT_FALSE(file.json["meshes"][0].contains("weights"));
}

/// The example with more cloth, over `times`.
AnimatedScene longExample(std::size_t times) {
  constexpr std::size_t kVertices = 150;
  AnimatedScene s = example();
  s.time_s.clear();
  for (MovedNode& n : s.nodes)
    if (n.at.size() > 1) n.at.clear();
  s.moving[0].at.assign(times, std::vector<float>(3 * kVertices));
  s.moving[0].colors.assign(kVertices, Color{0.5f, 0.5f, 0.5f});
  for (std::size_t k = 0; k < times; ++k) {
    const double t = 3 * static_cast<double>(k) / static_cast<double>(times - 1);
    s.time_s.push_back(t);
    for (std::size_t i = 0; i < 3 * kVertices; ++i)
      s.moving[0].at[k][i] = static_cast<float>(std::sin(0.37 * static_cast<double>(i) + t));
    for (std::size_t n : {0u, 1u}) s.nodes[n].at.push_back({rotationAbout({0, 0, 1}, t), {t, 1, -t}, 1});
  }
  return s;
}

TEST(Glb, ItsSizeIsKnownFromTwoTimes) {
  const GlbSize size = glbSize(longExample(2));
  for (const std::size_t times : {std::size_t{5}, std::size_t{50}, std::size_t{400}}) {
    const auto bytes = static_cast<double>(encodeGlb(longExample(times)).bytes.size());
    EXPECT_NEAR(size.bytes(times), bytes, 0.01 * bytes) << times;
    EXPECT_EQ(size.most(size.bytes(times) + 1), times);
    EXPECT_EQ(size.most(size.bytes(times) - 1), times - 1);
  }
  EXPECT_EQ(size.most(100), 0u);
}

TEST(Glb, PositionsThatAreNoNumbersAreRefused) {
  AnimatedScene scene = example();
  scene.moving[0].at[2][4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(encodeGlb(scene), RunError);
}

TEST(Obj, GroupsHaveTheVerticesOfTheTime) {
  AnimatedScene scene = example();
  scene.moving[0].name = "arm cloth";
  std::istringstream in(encodeObj(scene, 3));
  std::string word;
  std::vector<std::string> groups;
  std::vector<Vec3> x;
  int corners = 0, highest = 0;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    words >> word;
    if (word == "g") words >> groups.emplace_back();
    Vec3 p;
    if (word == "v" && words >> p.x >> p.y >> p.z) x.push_back(p);
    if (word == "f")
      for (int v; words >> v; ++corners) highest = std::max(highest, v);
  }
  EXPECT_EQ(groups, (std::vector<std::string>{"hand", "pebble", "skin", "arm_cloth"}));
  ASSERT_EQ(x.size(), 16u);
  EXPECT_EQ(highest, 16);
  EXPECT_EQ(corners, 4 * 6);
  EXPECT_EQ(static_cast<float>(x[13].y), scene.moving[0].at[3][4]);
  EXPECT_LT(norm(x[1] - worldOf(scene, 3)[1] * scene.fixed[0].mesh.vertices[1]), 1e-6);
  EXPECT_EQ(numbered("to/walk.v2.obj", 6), "to/walk.v2_0007.obj");
}

}  // namespace
}  // namespace gambeson
