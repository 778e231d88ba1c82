#include "human/recorded/bvh.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/curve.hpp"
#include "human/recorded/captured_motion.hpp"
#include "human/recorded/motion_file.hpp"
#include "unit/human/files/files.hpp"

namespace gambeson {
namespace {

using test::Folder;

const char* const own_map = R"json({"reads": "bones", "has": [], "forward": "z", "up": "y", "unit_m": 0.01,
 "root_position": "replaces", "pelvis": {"joint": "hips", "hips": ["thighR", "thighL"]},
 "torso": {"joint": "spine", "bone": ["spine", "neck"]},
 "bones": {"thigh_right": ["thighR", "shankR"], "shank_right": ["shankR", "footR"], "foot_right": ["footR", "toeR"],
  "thigh_left": ["thighL", "shankL"], "shank_left": ["shankL", "footL"], "foot_left": ["footL", "toeL"],
  "upper_arm_right": ["armR", "foreR"], "forearm_right": ["foreR", "handR"]}})json";

/// A body with y up that faces z, in centimetres times `unit`; its right arm points along `arm` in the rest pose.
/// Channels: root position, root rotation zxy, right thigh x, right shank x, right arm zxy, right forearm x y.
std::string skeleton(double unit, const Vec3& arm, const std::string& frames) {
  const auto offset = [&](double x, double y, double z) {
    return fmt::format("OFFSET {} {} {}\n", unit * x, unit * y, unit * z);
  };
  const auto leg = [&](const std::string& side, double x, const char* thigh, const char* shank) {
    return "JOINT thigh" + side + "\n{\n" + offset(x, -5, 0) + thigh + "JOINT shank" + side + "\n{\n" +
           offset(0, -45, 0) + shank + "JOINT foot" + side + "\n{\n" + offset(0, -42, 0) + "JOINT toe" + side +
           "\n{\n" + offset(0, -6, 14) + "End Site\n{\n" + offset(0, 0, 5) + "}\n}\n}\n}\n}\n";
  };
  std::string s = "HIERARCHY\nROOT hips\n{\n" + offset(10, 95, -20) +
                  "CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
  s += leg("R", -9, "CHANNELS 1 Xrotation\n", "CHANNELS 1 Xrotation\n") + leg("L", 9, "", "");
  s += "JOINT spine\n{\n" + offset(0, 10, 0) + "JOINT neck\n{\n" + offset(0, 45, 0) + "}\n";
  s += "JOINT armR\n{\n" + offset(-18, 40, 0) + "CHANNELS 3 Zrotation Xrotation Yrotation\nJOINT foreR\n{\n" +
       offset(30 * arm.x, 30 * arm.y, 30 * arm.z) + "CHANNELS 2 Xrotation Yrotation\nJOINT handR\n{\n" +
       offset(26 * arm.x, 26 * arm.y, 26 * arm.z) + "}\n}\n}\n}\n}\n";
  return s + frames;
}

class Bvh : public testing::Test {
 protected:
  Human human = makeManikin("male_p50");
  Folder folder;
  CapturedMotion read(const std::string& text, double unit_m, bool adds = false) {
    JointMap map = parseJointMap(own_map, "own");
    map.unit_m = unit_m, map.position_adds = adds;
    return recordBones(readBvh(folder.write("b.bvh", text)), map, human);
  }
  double deg(const CapturedMotion& r, int frame, const char* joint) const {
    return r.q[frame][human.skeleton.joint(joint)] / rad_per_deg;
  }
  void refused(const std::string& text, int line, const char* words) {
    test::expectRefused([](const auto& f) { readBvh(f); }, folder.write("b.bvh", text), line, words);
  }
};

// About x, which points left, a thigh turned by -30 degrees swings forward, a shank by +50 backward.
TEST_F(Bvh, HingesTurnAsTheBonesDo) {
  const std::string frames =
      "MOTION\nFrames: 2\nFrame Time: 0.1\n10 95 -20 0 0 0 0 0 0 0 0 0 0\n10 95 -20 0 0 0 -30 50 0 0 0 0 0\n";
  const CapturedMotion r = read(skeleton(1, {-1, 0, 0}, frames), 0.01);
  EXPECT_NEAR(deg(r, 1, "hip_flexion_right") - deg(r, 0, "hip_flexion_right"), 30, 1e-6);
  EXPECT_NEAR(deg(r, 1, "knee_flexion_right") - deg(r, 0, "knee_flexion_right"), 50, 1e-6);
  EXPECT_NEAR(deg(r, 1, "hip_flexion_left"), deg(r, 0, "hip_flexion_left"), 1e-9);
  EXPECT_NEAR(r.leg_m, 0.87, 1e-12);
  EXPECT_NEAR(deg(r, 0, "ankle_flexion_left"), 0,
              3);  // the foot's bone slopes, its sole is flat; our shank leans a little
}

// Written down with the arm to the side or hanging, the same motion in the world gives the same joints: 80 degrees down
// from the T about z are what the hanging arm has less, 10 degrees out.
TEST_F(Bvh, TheRestPoseDoesNotMatter) {
  const auto motion = [](double z, const char* elbow) {
    return fmt::format(
        "MOTION\nFrames: 2\nFrame Time: 0.1\n10 95 -20 0 0 0 0 9 {0} 0 0 {1}\n10 95 -20 0 0 0 0 9 {0} 0 0 {1}\n", z,
        elbow);
  };
  // T: the forearm bends forward about y; hanging: about x.
  const CapturedMotion t = read(skeleton(1, {-1, 0, 0}, motion(80, "0 40")), 0.01);
  const CapturedMotion hanging = read(skeleton(1, {0, -1, 0}, motion(-10, "-40 0")), 0.01);
  for (const char* joint :
       {"shoulder_flexion_right", "shoulder_abduction_right", "shoulder_rotation_right", "elbow_flexion_right"})
    EXPECT_NEAR(deg(t, 1, joint), deg(hanging, 1, joint), 1e-6) << joint;
  EXPECT_NEAR(deg(t, 1, "shoulder_abduction_right"), 10, 1e-6);
  EXPECT_NEAR(deg(t, 1, "elbow_flexion_right"), 40, 1e-6);
}

TEST_F(Bvh, UnitsAndRootPositionsMeanTheSamePlace) {
  const std::string end = " 0 90 0 0 0 0 0 0 0 0\n";
  const auto frames = [&](double u, double x, double y, double z) {
    return fmt::format("MOTION\nFrames: 2\nFrame Time: 0.1\n{0} {1} {2}{3}{0} {1} {2}{3}", u * x, u * y, u * z, end);
  };
  const CapturedMotion cm = read(skeleton(1, {-1, 0, 0}, frames(1, 110, 96, 5)), 0.01);
  const CapturedMotion dm = read(skeleton(0.1, {-1, 0, 0}, frames(0.1, 110, 96, 5)), 0.1);
  const CapturedMotion added = read(skeleton(1, {-1, 0, 0}, frames(1, 100, 1, 25)), 0.01, true);
  // Turned by 90 degrees about x (left) the body lies on its face: the hips, 5 cm below the root, are behind it.
  EXPECT_LT(norm(cm.hips[0] - Vec3{0.05 - 0.05, 1.10, 0.96}), 1e-12);
  EXPECT_LT(norm(dm.hips[0] - cm.hips[0]) + norm(added.hips[0] - cm.hips[0]), 1e-12);
  EXPECT_EQ(dm.q[0].size(), cm.q[0].size());
}

TEST_F(Bvh, MalformedFilesAreRefusedWithTheirLine) {
  const std::string motion = "MOTION\nFrames: 1\nFrame Time: 0.1\n";
  const std::string root = "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n}\n";
  EXPECT_EQ(readBvh(folder.write("good.bvh", root + motion + "1\n")).frames.size(), 1u);
  refused("order\n", 1, "does not start with HIERARCHY");
  refused("HIERARCHY\nROOT a\n{\nOFFSET 0 0\n}\n", 5, "not a finite number");
  refused("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Wrotation\n}\n", 5, "is no channel");
  refused("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 9 Xrotation\n}\n", 5, "1 to 6");
  refused("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 2 Xrotation Xrotation\n}\n", 5, "stands twice");
  refused("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nBONE b\n", 5, "is not known here");
  refused("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n", 4, "the file ends");
  refused(root + "MOTION\nFrames: 0\nFrame Time: 0.1\n1\n", 8, "is not allowed");
  refused(root + "MOTION\nFrames: 1\nFrame Time: 0\n1\n", 9, "is not allowed");
  refused(root + motion + "1 2\n", 10, "there are 1 channels");
  refused(root + motion + "nan\n", 10, "not a finite number");
  refused(root + motion, 9, "holds no frame");
  refused("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\nJOINT a\n{\nOFFSET 0 0 0\n}\n}\n", 6,
          "stands twice");
}

const char* const still =
    "MOTION\nFrames: 2\nFrame Time: 0.1\n10 95 -20 0 0 0 -30 50 0 0 0 0 0\n10 95 -20 0 0 0 -30 50 0 0 0 0 0\n";

/// Words of the format and channels in any case; names as they are.
TEST_F(Bvh, WordsStandInAnyCase) {
  const std::string text = skeleton(1, {0, -1, 0}, still);
  std::string other = text;
  for (const auto& [from, to] : {std::pair{"HIERARCHY", "Hierarchy"},
                                 {"ROOT", "Root"},
                                 {"CHANNELS", "Channels"},
                                 {"OFFSET", "offset"},
                                 {"JOINT", "joint"},
                                 {"Xposition", "XPOSITION"},
                                 {"Zrotation", "zrotation"},
                                 {"End Site", "END SITE"},
                                 {"Frame Time:", "FRAME TIME:"}})
    for (std::size_t at = 0; (at = other.find(from, at)) != std::string::npos;)
      other.replace(at, std::string(from).size(), to), at += std::string(to).size();
  ASSERT_NE(other, text);
  EXPECT_EQ(read(other, 0.01).q, read(text, 0.01).q);
}

/// A foot that ends in an end site, where the map names a joint that the file lacks.
TEST_F(Bvh, FeetMayEndInEndSites) {
  const std::string text = skeleton(1, {0, -1, 0}, still);
  std::string bare = text;
  for (const char* side : {"R", "L"}) {
    const std::string joint = std::string("JOINT toe") + side + "\n{\n";
    const std::size_t at = bare.find(joint), site = bare.find("End Site\n{\n", at), end = bare.find("}\n}\n", site);
    const std::string offset = bare.substr(at + joint.size(), site - at - joint.size());
    bare.replace(at, end + 4 - at, "End Site\n{\n" + offset + "}\n");
  }
  EXPECT_EQ(read(bare, 0.01).q, read(text, 0.01).q);
}

/// The format of maps is written down where they are: every key of those that ship, and of one's own.
TEST(JointMaps, EveryKeyIsDocumented) {
  const std::filesystem::path folder = std::filesystem::path(GAMBESON_SOURCE_DIR) / "human/data";
  std::ifstream stream(folder / "MAPS.md");
  const std::string words(std::istreambuf_iterator<char>(stream), {});
  ASSERT_FALSE(words.empty());
  for (const char* key :
       {"reads",    "has",           "lacks",   "forward",     "up",     "about",      "source",   "turns",
        "position", "hips_m",        "joints",  "from",        "scale",  "offset_deg", "optional", "leg_m",
        "unit_m",   "root_position", "pelvis",  "torso",       "head",   "bones",      "bodies",   "knee_scale",
        "marker",   "side",          "markers", "coordinates", "points", "replaces",   "adds"})
    EXPECT_NE(words.find(key), std::string::npos) << key;
}

}  // namespace
}  // namespace gambeson
