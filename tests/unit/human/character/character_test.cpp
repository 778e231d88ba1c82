/// Characters from files: what is known of one that is made from our own manikin comes back, and real ones stand and
/// walk.

#include "human/character/character.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/contact/mesh_topology.hpp"
#include "core/error.hpp"
#include "human/files/mesh.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/standing.hpp"
#include "human/motion/walk.hpp"
#include "human/skeleton/joint_map.hpp"
#include "human/skin/overlap.hpp"
#include "tools/data_folder.hpp"
#include "unit/human/character/character_body.hpp"
#include "unit/human/files/files.hpp"

namespace gambeson {
namespace {

using test::characterBody;
using test::CharacterBody;
using test::Folder;

const CharacterBody& body(bool t_pose) {
  static const CharacterBody t = characterBody(90), a = characterBody(45);
  return t_pose ? t : a;
}

Human loaded(const Folder& folder, const CharacterBody& c, CharacterReport* report = nullptr) {
  CharacterOptions o;
  o.file = writeGltf(folder.path / "man.gltf", c.bones, {test::box({0.1, 0, 1.65}, 4), c.part()}, true);
  return loadCharacter(o, report);
}

TEST(Character, ComesBackFromItsFile) {
  const Folder folder;
  for (const bool t_pose : {true, false}) {
    const CharacterBody& c = body(t_pose);
    CharacterReport report;
    const Human h = loaded(folder, c, &report);
    EXPECT_EQ(report.pose, t_pose ? 'T' : 'A');
    EXPECT_NEAR(report.arms_deg, t_pose ? 90 : 45, 1e-4);
    EXPECT_EQ(report.map, "unreal");
    EXPECT_NEAR(h.mass_kg, 1000 * report.volume_m3, 1e-9);
    const Skin& s = *h.skin;
    EXPECT_TRUE(meshTopology(s.rest).closed);
    EXPECT_EQ(s.rest.vertices.size(), c.skin.vertices.size());  // 12 box triangles left out, corners welded
    EXPECT_EQ(s.rest.triangles.size(), c.skin.triangles.size());
    // Where each joint sits in its parent (single precision of the file).
    for (std::size_t j = 0; j < h.skeleton.joints.size(); ++j)
      EXPECT_LT(norm(h.skeleton.joints[j].X_PJ.origin - c.human.skeleton.joints[j].X_PJ.origin), 1e-6)
          << h.skeleton.joints[j].name;
    // Centres of mass too, in trunk, head, hands and feet by stature alone.
    const double taller = h.stature_m / makeManikin("male_p50").stature_m;
    for (std::size_t l = 0; l < h.skeleton.links.size(); ++l) {
      const Link &mine = h.skeleton.links[l], &its = c.human.skeleton.links[l];
      EXPECT_LT(norm(mine.center_of_mass - its.center_of_mass), 1e-6 + std::abs(taller - 1) * norm(its.center_of_mass))
          << mine.name;
    }
    for (std::size_t v = 0; v + 1 < s.first.size(); ++v) {
      double sum = 0;
      for (int i = s.first[v]; i < s.first[v + 1]; ++i) sum += s.weight[i];
      ASSERT_NEAR(sum, 1, 1e-12);
    }
  }
}

/// In any posture each link stands as the manikin's that the character was made from, and the skin moves with it: in
/// the file's own pose it is the file's.
TEST(Character, IsDrivenAsTheManikinThatItWasMadeFrom) {
  const Folder folder;
  for (const bool t_pose : {true, false}) {
    const CharacterBody& c = body(t_pose);
    const Human h = loaded(folder, c);
    const auto walk = makeWalk(c.human, {});
    for (const double t : {0.0, 0.7, 1.1}) {
      const Posture p = walk->at(t);
      const auto X = linkPoses(h.skeleton, p.q, p.root), Y = linkPoses(c.human.skeleton, p.q, p.root);
      for (std::size_t l = 0; l < X.size(); ++l) {
        EXPECT_LT(norm(X[l].origin - Y[l].origin), 1e-5) << h.skeleton.links[l].name;
        for (int k = 0; k < 3; ++k) {
          Vec3 e;
          e[k] = 1;
          EXPECT_LT(norm(X[l].rotation * e - Y[l].rotation * e), 1e-5);
        }
      }
    }
    std::vector<Vec3> x(h.skin->rest.vertices.size());
    skinPositions(*h.skin, linkPoses(h.skeleton, c.pose.q, c.pose.root), x);
    const Vec3 onto = h.skin->bind[0].origin - c.pose.root.origin;  // the file's lowest point stands on the ground
    for (std::size_t v = 0; v < x.size(); ++v) EXPECT_LT(norm(x[v] + onto - h.skin->rest.vertices[v]), 1e-6);
    EXPECT_LT(norm(onto), 2e-3);
    // The file's vertices, in the order in which its triangles name them.
    std::vector<int> order(x.size(), -1);
    for (std::size_t t = 0; t < c.skin.triangles.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) order[h.skin->rest.triangles[t][k]] = c.skin.triangles[t][k];
    for (std::size_t v = 0; v < x.size(); ++v) EXPECT_LT(norm(x[v] - c.skin.vertices[order[v]]), 2e-6);
  }
}

TEST(Character, IsScaledTurnedAndPutOnTheGround) {
  const Folder folder;
  CharacterBody c = body(true);
  const Mat3 R = rotationAbout({0, 0, 1}, M_PI / 2) * rotationAbout({1, 0, 0}, M_PI / 2);
  const auto moved = [&](Vec3& x) { x = 100 * (R * x) + Vec3{30, -70, 20}; };
  for (Vec3& x : c.skin.vertices) moved(x);
  for (test::GltfBone& b : c.bones) moved(b.at);
  CharacterOptions o;
  o.file = writeGltf(folder.path / "turned.gltf", c.bones, {c.part()});
  test::expectRefused([&](auto) { loadCharacter(o); }, o.file, 0, "say what it should be");  // centimetres
  o.height_m = 1.6;
  o.mass_kg = 55;
  const Human h = loadCharacter(o);
  EXPECT_NEAR(h.stature_m, 1.6, 1e-12);
  double sum = 0, low = 1, high = 0;
  for (const Link& l : h.skeleton.links) sum += l.mass_kg;
  EXPECT_NEAR(sum, 55, 1e-9);
  for (const Vec3& x : h.skin->rest.vertices) low = std::min(low, x.z), high = std::max(high, x.z);
  EXPECT_NEAR(low, 0, 1e-6);
  EXPECT_NEAR(high, 1.6, 1e-6);
  const Vec3 left = h.skin->bind[h.skeleton.link("hand_left")].origin,
             toes = h.skin->bind[h.skeleton.link("foot_left")] * Vec3{0.1, 0, 0} -
                    h.skin->bind[h.skeleton.link("foot_left")].origin;
  EXPECT_GT(left.y, 0.5);
  EXPECT_GT(toes.x, 0.09);
}

/// A coarse skin bound in a T-pose folds where the arms hang down; what is switched off is not touched at all,
/// the rest is as it was.
TEST(Character, WhatIsSwitchedOffIsNotTouched) {
  const Folder folder;
  Human h = loaded(folder, body(true));
  const auto walk = makeWalk(h, {});
  const OverlapOfMotion o = overlapOf(h, *walk, 0.2);
  const auto off = std::count(o.triangles.begin(), o.triangles.end(), 1);
  ASSERT_GT(off, 0);
  EXPECT_LE(o.folded, o.instants);
  EXPECT_GE(o.area_m2, 0.5 * o.largest_m2);  // in the T-pose, where the armpits are stretched
  EXPECT_FALSE(o.links.empty());
  Skin skin = *h.skin;
  skin.off = o.triangles;
  const std::size_t all = skin.rest.triangles.size();
  h.skin = std::make_shared<const Skin>(std::move(skin));
  const Obstacle obstacle = obstaclesOf(h)[0];
  const auto& left = std::get<TriangleMesh>(obstacle.shape);
  EXPECT_EQ(left.triangles.size() + static_cast<std::size_t>(off), all);
  EXPECT_EQ(left.vertices.size(), h.skin->rest.vertices.size());  // numbers of vertices stay
  for (std::size_t t = 0; t < all; ++t) {
    const bool there =
        std::find(left.triangles.begin(), left.triangles.end(), h.skin->rest.triangles[t]) != left.triangles.end();
    EXPECT_EQ(there, !o.triangles[t]);
  }
}

TEST(Character, ClipsOfManyRigsNameTheirBonesInTheMapsThatShip) {
  for (const char* name : {"unreal", "mixamo", "makehuman_default"}) EXPECT_EQ(findJointMap(name).kind, MapKind::bones);
}

TEST(Character, SaysWhatIsWrongWithAFile) {
  const Folder folder;
  const CharacterBody& c = body(true);
  CharacterOptions o;
  const auto refused = [&](const std::string& name, const std::vector<test::GltfBone>& bones,
                           const std::vector<test::GltfPart>& parts, const std::string& words) {
    o.file = writeGltf(folder.path / (name + ".gltf"), bones, parts);
    test::expectRefused([&](auto) { loadCharacter(o); }, o.file, 0, words);
  };
  const auto with = [&](auto change) {
    CharacterBody d = c;
    change(d);
    return d;
  };
  refused("statue", {}, {{"Body", c.skin, {}}}, "has no skeleton");
  CharacterBody d = with([](auto& b) { b.bones[1].name = "bone_1"; });
  refused("unknown", d.bones, {d.part()}, "map: no map that ships goes with its bones (ROOT, root, bone_1, spine_01");
  o.map = "unreal";
  refused("lacking", d.bones, {d.part()}, "pelvis.joint: the character has no bone 'pelvis'");
  o.map = "gait2392";
  refused("kind", c.bones, {c.part()}, "map: 'gait2392' does not read bones");
  o.map = "";
  d = with([](auto& b) { b.skin.triangles.pop_back(); });
  refused("open", d.bones, {d.part()}, "not a closed surface: 3 of its edges");
  d = with([](auto& b) { b.weights[7].clear(), b.weights[9].clear(); });
  refused("unbound", d.bones, {d.part()}, fmt::format("weights: 2 of {} vertices", c.skin.vertices.size()));
  d = with([](auto& b) {
    for (auto& bone : b.bones)
      if (bone.name.ends_with("_l"))
        bone.name.back() = 'r';
      else if (bone.name.ends_with("_r"))
        bone.name.back() = 'l';
  });
  refused("mirrored", d.bones, {d.part()}, "left and right are confused");
  d = with([](auto& b) {
    for (auto& bone : b.bones)
      if (bone.name == "calf_l") bone.at = b.bones[5].at;
  });
  refused("folded", d.bones, {d.part()}, "map: the bones of thigh_left and shank_left start at the same place");
  d = with([](auto& b) {
    for (auto& list : b.weights) list = {{1, 1.0}};
  });
  refused("rigid", d.bones, {d.part()}, "weights: no part of the body moves with the bone of");

  o.file = folder.path / "none.gltf";
  test::expectRefused([&](auto) { loadCharacter(o); }, o.file, 0, "");
  o.file = folder.write("man.stl", "solid\nendsolid\n");
  test::expectRefused([&](auto) { loadCharacter(o); }, o.file, 0, "characters are read from .gltf");
  o.file = folder.write("torn.gltf", "{\"asset\": ");
  test::expectRefused([&](auto) { loadCharacter(o); }, o.file, 0, "");
  o.file = writeGltf(folder.path / "man.gltf", c.bones, {c.part()});
  o.targets = {{folder.path / "x.target", 1}};
  test::expectRefused([&](auto) { loadCharacter(o); }, o.file, 0, "targets: go with MakeHuman's mesh");
}

TEST(Character, ItsFilesAreThoseThatItsGeometryComesFrom) {
  const Folder folder;
  const CharacterBody& c = body(true);
  const auto file = writeGltf(folder.path / "man.gltf", c.bones, {c.part()});
  EXPECT_EQ(filesBeside(file), std::vector<std::filesystem::path>{folder.path / "man.bin"});
  EXPECT_TRUE(filesBeside(folder.path / "man.bin").empty());
}

/// MakeHuman's files: a body of quads in a group, joints as means of vertices, a target.
class MakeHumanFile : public testing::Test {
 protected:
  /// The manikin's skin stands for the body; after it come single vertices at the joints, in a group that is no body.
  void SetUp() override {
    const CharacterBody& c = body(false);
    std::string obj, skeleton, joints, weights;
    const auto v = [&](const Vec3& x) { obj += fmt::format("v {:.6f} {:.6f} {:.6f}\n", 10 * x.y, 10 * x.z, 10 * x.x); };
    for (const Vec3& x : c.skin.vertices) v(x);
    for (const auto& b : c.bones) v(b.at);
    obj += "g body\n";
    for (const auto& t : c.skin.triangles) obj += fmt::format("f {}/1 {}/1 {}/1\n", t[0] + 1, t[1] + 1, t[2] + 1);
    const std::size_t n = c.skin.vertices.size();
    obj += fmt::format("g joint-x\nf {} {} {}\n", n + 1, n + 2, n + 3);
    std::vector<std::string> of(c.bones.size());
    for (std::size_t i = 0; i < n; ++i)
      for (const auto& [b, w] : c.weights[i]) of[b] += fmt::format("{}[{}, {:.6f}]", of[b].empty() ? "" : ",", i, w);
    for (std::size_t b = 0; b < c.bones.size(); ++b) {
      const std::string parent = c.bones[b].parent < 0 ? "null" : "\"" + c.bones[c.bones[b].parent].name + "\"";
      skeleton +=
          fmt::format("{}\"{}\": {{\"parent\": {}, \"head\": \"j{}\"}}", b ? ",\n" : "", c.bones[b].name, parent, b);
      joints += fmt::format("{}\"j{}\": [{}]", b ? "," : "", b, n + b);
      weights += fmt::format("{}\"{}\": [{}]", b ? "," : "", c.bones[b].name, of[b]);
    }
    o.file = folder.write("base.obj", obj);
    skeleton_text = fmt::format("{{\"bones\": {{{}}}, \"joints\": {{{}}}}}", skeleton, joints);
    o.skeleton = folder.write("rig.mhskel", skeleton_text);
    o.weights = folder.write("rig.mhw", fmt::format("{{\"weights\": {{{}}}}}", weights));
  }
  Folder folder;
  CharacterOptions o;
  std::string skeleton_text;
};

TEST_F(MakeHumanFile, IsReadInDecimetresAndMorphed) {
  const CharacterBody& c = body(false);
  const Human h = loadCharacter(o);
  EXPECT_EQ(h.skin->rest.vertices.size(), c.skin.vertices.size());
  for (std::size_t j = 0; j < h.skeleton.joints.size(); ++j)
    EXPECT_LT(norm(h.skeleton.joints[j].X_PJ.origin - c.human.skeleton.joints[j].X_PJ.origin), 2e-6);
  // A target that lifts every other vertex, and all joints, by 1 dm: half of it moves the head 5 cm.
  std::string target = "# raises the head\n";
  const std::size_t n = c.skin.vertices.size();
  for (std::size_t b = 0; b < c.bones.size(); ++b)
    if (c.bones[b].name == "neck_01") target += fmt::format("{} 0 1 0\n", n + b);
  o.targets = {{folder.write("up.target", target), 0.5}};
  const Human taller = loadCharacter(o);
  const int j = h.skeleton.joint("neck_flexion");
  EXPECT_NEAR(taller.skeleton.joints[j].X_PJ.origin.z - h.skeleton.joints[j].X_PJ.origin.z, 0.05, 1e-6);
}

TEST_F(MakeHumanFile, SaysWhatIsWrong) {
  const auto refused = [&](const std::filesystem::path& file, const std::string& words, int line = 0) {
    test::expectRefused([&](auto) { loadCharacter(o); }, file, line, words);
  };
  CharacterOptions good = o;
  o.skeleton.clear();
  refused(o.file, "skeleton: is required for MakeHuman's mesh");
  o = good;
  o.targets = {{folder.write("a.target", "# x\n1 0 0\n"), 1}};
  refused(o.targets[0].file, "a vertex and three lengths", 2);
  o.targets = {{folder.write("b.target", "999999 0 0 1\n"), 1}};
  refused(o.targets[0].file, "names vertex 999999", 1);
  o = good;
  o.weights = folder.write("a.mhw", "{\"weights\": {\"tail\": [[0, 1]]}}");
  refused(o.weights, "weights.tail: there is no such bone");
  o.weights = folder.write("b.mhw", "{\"weights\": {\"root\": [[0, 1], [-1, 1]]}}");
  refused(o.weights, "weights.root[1]: must be a vertex of the mesh and a weight");
  o = good;
  o.skeleton = folder.write("a.mhskel", test::replaced(skeleton_text, "\"parent\": \"root\"", "\"parent\": \"tail\""));
  refused(o.skeleton, "there is no bone 'tail'");
  o.skeleton = folder.write("c.mhskel", test::replaced(skeleton_text, "\"parent\": null", "\"parent\": \"ball_l\""));
  refused(o.skeleton, "bones: some hang from each other in a circle");
  o.skeleton = folder.write("b.mhskel", test::replaced(skeleton_text, "\"head\": \"j3\"", "\"head\": \"k3\""));
  refused(o.skeleton, "there is no joint 'k3'");
  o = good;
  o.file = folder.write("c.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n");
  refused(o.file, "group: has no faces in the group 'body'");
  o.file = folder.write("d.obj", "v 0 0 0\nv 1 0 0\ng body\nf 1 2 3\n");
  refused(o.file, "names vertex 3 of 2", 4);
  for (const char* corner : {"1.5", "0", "-1", "1e300", "4294967297"}) {
    o.file = folder.write("e.obj", fmt::format("v 0 0 0\nv 1 0 0\nv 0 1 0\ng body\nf {}/1 2/1 3/1\n", corner));
    refused(o.file, fmt::format("names vertex {} of 3", corner), 5);
  }
}

/// Bones hang from each other against the order of their names, and all of them start at one joint.
TEST_F(MakeHumanFile, ChainsOfBonesMayBeLongAndInAnyOrder) {
  constexpr int count = 3000;
  std::string chain = "{\"bones\": {";
  for (int b = 0; b < count; ++b)
    chain += fmt::format("\"b{:05}\": {{\"head\": \"j0\", \"parent\": \"{}\"}},\n", b,
                         b + 1 < count ? fmt::format("b{:05}", b + 1) : "root");
  o.skeleton = folder.write("chain.mhskel", test::replaced(skeleton_text, "{\"bones\": {", chain));
  const Human with = loadCharacter(o);
  o.skeleton = folder.write("plain.mhskel", skeleton_text);
  const Human without = loadCharacter(o);
  for (std::size_t j = 0; j < with.skeleton.joints.size(); ++j)
    EXPECT_EQ(with.skeleton.joints[j].X_PJ.origin, without.skeleton.joints[j].X_PJ.origin);
}

/// The public characters: sizes as their files have them; a walk leaves the feet on the ground.
TEST(RealCharacters, StandAndWalk) {
  const auto folder = test::dataFolder() / "real" / "body";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  CharacterOptions male, makehuman;
  male.file = folder / "quaternius_Superhero_Male_FullBody.gltf";
  makehuman.file = folder / "makehuman_base.obj";
  makehuman.skeleton = folder / "makehuman_default.mhskel";
  makehuman.weights = folder / "makehuman_default_weights.mhw";
  makehuman.targets = {{folder / "makehuman_caucasian_male_young.target", 1},
                       {folder / "makehuman_male_maxmuscle_averageweight.target", 1}};
  for (const CharacterOptions& o : {male, makehuman}) {
    const bool t_pose = o.targets.empty();
    CharacterReport report;
    const Human h = loadCharacter(o, &report);
    EXPECT_EQ(report.pose, t_pose ? 'T' : 'A');
    EXPECT_EQ(h.skin->rest.vertices.size(), t_pose ? 6285u : 13380u);
    EXPECT_TRUE(meshTopology(h.skin->rest).closed);
    EXPECT_NEAR(h.stature_m, t_pose ? 1.8196 : 1.7481, 1e-3);
    // Standing, the lowest point of the skin is within 15 mm of the ground: feet turn by a few degrees under hips that
    // are held apart.
    std::vector<Vec3> x(h.skin->rest.vertices.size());
    const auto lowest = [&](const Posture& p) {
      skinPositions(*h.skin, linkPoses(h.skeleton, p.q, p.root), x);
      double z = 1;
      for (const Vec3& v : x) z = std::min(z, v.z);
      return z;
    };
    EXPECT_NEAR(lowest(standing(h)), 0, 0.015);
    const auto walk = makeWalk(h, {});
    for (int i = 0; i <= 8; ++i) EXPECT_NEAR(lowest(walk->at(0.5 + 1.1 * i / 8)), 0, 0.03) << i;
  }
}

}  // namespace
}  // namespace gambeson
