/// Public captures of walking (see their manifest); skipped where they are not there.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/standing.hpp"
#include "human/recorded/captured_motion.hpp"
#include "human/recorded/motion_file.hpp"
#include "tools/data_folder.hpp"
#include "unit/human/files/files.hpp"

namespace gambeson {
namespace {

class MotionData : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(motions)) GTEST_SKIP() << "no public data at " << test::dataFolder();
  }
  std::filesystem::path motions = test::dataFolder() / "real/motion",
                        model = test::dataFolder() / "real/human/opensim_subject01_gait2392_scaled.osim";
  Human human = makeManikin("male_p50");
};

// The same walk by OpenSim's inverse kinematics and by our own fit of its markers, 3.07 to 4.0 s: within 4 degrees RMS
// at hips and knees. Measured: 0.9 to 3.0 at the hips, 2.0 at the knees.
TEST_F(MotionData, MarkersAgreeWithTheInverseKinematicsOfTheSameWalk) {
  const StorageTable table = readStorage(motions / "opensim_gait2392_subject01_walk1_ik.mot");
  const CapturedMotion mot = recordAngles(table, findJointMap("gait2392"), human);
  const OsimModel osim = readOsim(model);
  const MarkerTable markers = readTrc(motions / "opensim_gait2392_subject01_walk_free_01.trc");
  ASSERT_EQ(markers.times.size(), 73u);
  EXPECT_EQ(markers.notes, std::vector<std::string>{"the header names 900 frames, the file holds 73"});
  const CapturedMotion trc = recordMarkers(markers, findJointMap("gait2392_markers"), &osim, human);
  for (const char* side : {"_right", "_left"})
    for (const char* joint : {"hip_flexion", "hip_adduction", "hip_rotation", "knee_flexion"}) {
      const std::string name = std::string(joint) + side;
      const int j = human.skeleton.joint(name);
      double square = 0;
      int n = 0;
      for (std::size_t i = 0; i < trc.times.size(); ++i) {
        if (trc.times[i] > 4.0005) continue;
        std::size_t k = 0;
        while (k + 2 < mot.times.size() && mot.times[k + 1] < trc.times[i]) ++k;
        const double u = (trc.times[i] - mot.times[k]) / (mot.times[k + 1] - mot.times[k]);
        square += std::pow(trc.q[i][j] - (1 - u) * mot.q[k][j] - u * mot.q[k + 1][j], 2), ++n;
      }
      EXPECT_EQ(n, 57);
      const double rms_deg = std::sqrt(square / n) / rad_per_deg;
      RecordProperty(name + "_rms_deg", std::to_string(rms_deg));
      EXPECT_LT(rms_deg, 4) << name;
    }
}

/// Joints of a file's hierarchy, from and to, and the link whose bone lies along them with the joint at its end.
struct Bone {
  const char *from, *to, *link, *end;
};

// Computed here from the hierarchy by itself: each bone's direction in the world, turned to our axes.
TEST_F(MotionData, BonesPointAsInTheFile) {
  struct File {
    const char *name, *map;
    Vec3 forward, up;
    bool adds;
    std::vector<Bone> bones;
  };
  const std::vector<File> files{{"snu_woody_walk_normal_straight.bvh",
                                 "snu_woody",
                                 {0, 0, 1},
                                 {0, 1, 0},
                                 false,
                                 {{"RightUpLeg", "RightLeg", "thigh_right", "knee_flexion_right"},
                                  {"RightLeg", "RightFoot", "shank_right", "ankle_flexion_right"},
                                  {"LeftUpLeg", "LeftLeg", "thigh_left", "knee_flexion_left"},
                                  {"LeftLeg", "LeftFoot", "shank_left", "ankle_flexion_left"},
                                  {"Spine", "HEad", "torso", "neck_flexion"},
                                  {"RightArm", "RightForeArm", "upper_arm_right", "elbow_flexion_right"},
                                  {"RightForeArm", "RightHand", "forearm_right", "wrist_right"},
                                  {"LeftArm", "LeftForeArm", "upper_arm_left", "elbow_flexion_left"},
                                  {"LeftForeArm", "LeftHand", "forearm_left", "wrist_left"}}},
                                {"makehuman_walk1.bvh",
                                 "makehuman",
                                 {0, -1, 0},
                                 {0, 0, 1},
                                 true,
                                 {{"UpLeg_R", "LoLeg_R", "thigh_right", "knee_flexion_right"},
                                  {"LoLeg_R", "Foot_R", "shank_right", "ankle_flexion_right"},
                                  {"UpLeg_L", "LoLeg_L", "thigh_left", "knee_flexion_left"},
                                  {"LoLeg_L", "Foot_L", "shank_left", "ankle_flexion_left"},
                                  {"Spine1", "Neck", "torso", "neck_flexion"},
                                  {"UpArm_R", "LoArm_R", "upper_arm_right", "elbow_flexion_right"},
                                  {"LoArm_R", "Hand_R", "forearm_right", "wrist_right"},
                                  {"UpArm_L", "LoArm_L", "upper_arm_left", "elbow_flexion_left"},
                                  {"LoArm_L", "Hand_L", "forearm_left", "wrist_left"}}}};
  const Skeleton& s = human.skeleton;
  std::vector<File> all = files;
  all.push_back(files[0]);
  all.back().name = "snu_woody_low_walk.bvh";
  for (const File& f : all) {
    const BvhClip clip = readBvh(motions / f.name);
    const CapturedMotion r = recordBones(clip, findJointMap(f.map), human);
    const Vec3 left = cross(f.up, f.forward);
    std::map<std::string, double> worst;
    for (std::size_t i = 0; i < clip.frames.size(); ++i) {
      const auto theirs = bvhPoses(clip, clip.frames[i], f.adds);
      const auto ours = linkPoses(s, r.q[i], {r.pelvis[i], r.hips[i]});
      for (const Bone& b : f.bones) {
        const Vec3 d = normalized(theirs[clip.joint(b.to)].origin - theirs[clip.joint(b.from)].origin);
        const Vec3 wanted{dot(f.forward, d), dot(left, d), dot(f.up, d)};
        const Vec3 got = ours[s.link(b.link)].rotation * normalized(s.joints[s.joint(b.end)].X_PJ.origin);
        double& w = worst[b.link];
        w = std::max(w, std::atan2(norm(cross(wanted, got)), dot(wanted, got)) / rad_per_deg);
      }
    }
    for (const auto& [link, deg] : worst) EXPECT_LT(deg, 2) << f.name << " " << link;
  }
}

// Each drives the human through a stride: forward, upright, on the ground, joints where joints can be.
TEST_F(MotionData, EachWalksTheHumanUprightOnTheGroundAndForward) {
  struct Case {
    const char* name;
    double from, to;
    bool treadmill;
    int repeat;
    double slower, deepest_mm, highest_mm;
  };
  for (const Case& c : {Case{"opensim_gait2392_subject01_walk1_ik.mot", 1, 2.4, true, 1, 1, 8, 12},
                        Case{"opencap_walking1.mot", 0, 1.57, false, 1, 1, 16, 16},
                        Case{"opensim_gait2392_subject01_walk_free_01.trc", 3.067, 4.267, true, 1, 1, 8, 12},
                        Case{"snu_woody_walk_normal_straight.bvh", 3, 6, false, 1, 1, 8, 12},
                        Case{"snu_woody_low_walk.bvh", 2, 5, false, 1, 1, 8, 12},
                        Case{"makehuman_walk1.bvh", 0, 1.0833, true, 2, 1.8, 16, 18}}) {
    SCOPED_TRACE(c.name);
    MotionFileOptions o;
    o.path = motions / c.name;
    if (o.path.extension() == ".trc") o.model = model;
    o.from_s = c.from, o.to_s = c.to, o.repeat = c.repeat, o.slower = c.slower;
    if (c.treadmill) o.travel = Travel::feet;
    MotionFileNotes notes;
    const auto m = loadMotionFile(o, human, &notes);
    EXPECT_LT(1e3 * notes.feet.deepest_m, c.deepest_mm);
    EXPECT_LT(1e3 * notes.feet.highest_m, c.highest_mm);
    const double begin = notes.window_s, end = m->duration();
    const Vec3 way = m->at(end).root.origin - m->at(begin).root.origin;
    EXPECT_GT(way.x, 0.6 * (end - begin));  // a slow walk goes 0.6 m/s
    EXPECT_LT(std::abs(way.y), 0.2 * way.x);
    const double leg = standing(human).root.origin.z;
    double knee = 0;
    for (int i = 0; i <= 200; ++i) {
      const Posture p = m->at(end * i / 200);
      EXPECT_GT(p.root.rotation.c.z, std::cos(50 * rad_per_deg));
      EXPECT_GT(p.root.rotation.a.x, std::cos(30 * rad_per_deg));
      EXPECT_GT(p.root.origin.z, 0.6 * leg);
      EXPECT_LT(p.root.origin.z, 1.05 * leg);
      knee = std::max(knee, p.q[human.skeleton.joint("knee_flexion_right")]);
    }
    EXPECT_GT(knee, 45 * rad_per_deg);  // the leg swings through
  }
}

TEST_F(MotionData, WhatIsNoMotionSaysWhatToDo) {
  MotionFileOptions o;
  o.path = motions / "opensim_test_walking.c3d";
  test::expectRefused([&](const auto&) { loadMotionFile(o, human); }, o.path, 0, "write its markers as .trc");
  o.path = motions / "snu_woody_low_walk.bvh";
  o.from_s = 70, o.to_s = 100;
  test::expectRefused([&](const auto&) { loadMotionFile(o, human); }, o.path, 0, "the file runs from 0 to 78");
}

}  // namespace
}  // namespace gambeson
