/// ExternalLoads read back: what they do to the body is what the windows gave it.

#include "analysis/opensim.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/walk.hpp"
#include "human/recorded/storage.hpp"

namespace gambeson {
namespace {

TEST(OpenSim, BodiesAndAxes) {
  EXPECT_EQ(openSimBody("thigh_left"), "femur_l");
  EXPECT_EQ(openSimBody("foot_right"), "calcn_r");
  EXPECT_EQ(openSimBody("upper_arm_right"), "humerus_r");
  EXPECT_EQ(openSimBody("head"), "torso");
  EXPECT_EQ(openSimBody("pelvis"), "pelvis");
  EXPECT_EQ(openSimBody("wing_left"), "wing_left");
  EXPECT_EQ(openSimGround({1, 0, 0}), (Vec3{1, 0, 0}));   // forward
  EXPECT_EQ(openSimGround({0, 0, 1}), (Vec3{0, 1, 0}));   // up
  EXPECT_EQ(openSimGround({0, -1, 0}), (Vec3{0, 0, 1}));  // to the right
  EXPECT_EQ(cross(openSimGround({1, 0, 0}), openSimGround({0, 0, 1})), openSimGround(cross({1, 0, 0}, {0, 0, 1})));
}

/// Forces and their moments about a fixed point of the world, summed over the bodies of the files and over the links of
/// the windows.
TEST(OpenSim, TheFilesHoldTheForcesAndMomentsOfTheLedger) {
  const Human human = makeManikin("male_p50");
  const auto motion = makeWalk(human, {});
  std::mt19937 rng(7);
  std::normal_distribution<double> normal;
  const auto random = [&] { return Vec3{normal(rng), normal(rng), normal(rng)}; };
  std::vector<ContactWindow> windows;
  std::vector<double> time_s;
  for (int w = 0; w < 6; ++w) {
    ContactWindow window{0.1 + 0.01 * w, 0.11 + 0.01 * w, {}};
    window.links.resize(human.skeleton.links.size());
    for (const char* link : {"torso", "head", "thigh_left", "thigh_right", "pelvis"})
      window.links[static_cast<std::size_t>(human.skeleton.link(link))] = {0.01 * random(), 0.01 * random()};
    if (w == 3) window.links[static_cast<std::size_t>(human.skeleton.link("pelvis"))] = {};
    windows.push_back(window);
    time_s.push_back(window.middle());
  }
  const std::vector<ExternalLoad> loads = externalLoads(human, *motion, 0, windows);
  ASSERT_EQ(loads.size(), 4u);  // the head is OpenSim's torso
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "gambeson_opensim_test";
  std::filesystem::create_directories(folder);
  writeExternalLoads(folder / "loads", "a <run> & more", time_s, loads);

  const StorageTable table = readStorage(folder / "loads.mot");
  EXPECT_TRUE(table.notes.empty());
  EXPECT_FALSE(table.in_degrees);
  ASSERT_EQ(table.times.size(), windows.size());
  EXPECT_EQ(table.names.size(), 9 * loads.size());
  const Vec3 about{0.3, -0.2, 1};
  for (std::size_t w = 0; w < windows.size(); ++w) {
    EXPECT_EQ(table.times[w], time_s[w]);
    const Posture posture = motion->at(time_s[w]);
    const std::vector<Pose> X_WL = linkPoses(human.skeleton, posture.q, posture.root);
    Vec3 force, moment;
    for (std::size_t l = 0; l < X_WL.size(); ++l) {
      force += windows[w].links[l].force_Ns / 0.01;
      moment += (windows[w].links[l].moment_Nms + cross(X_WL[l].origin - about, windows[w].links[l].force_Ns)) / 0.01;
    }
    Vec3 F, M;
    for (const ExternalLoad& load : loads) {
      const auto value = [&](const std::string& part) {
        Vec3 v;
        double* at[] = {&v.x, &v.y, &v.z};
        for (int k = 0; k < 3; ++k)
          *at[k] = table.columns[static_cast<std::size_t>(table.column(load.body + part + "xyz"[k]))][w];
        return v;
      };
      F += value("_force_v");
      M += value("_torque_") + cross(value("_force_p") - openSimGround(about), value("_force_v"));
    }
    EXPECT_LT(norm(F - openSimGround(force)), 1e-12);
    EXPECT_LT(norm(M - openSimGround(moment)), 1e-12);
  }
  // The thigh's force acts at the hip.
  const Posture posture = motion->at(time_s[0]);
  const Vec3 hip =
      linkPoses(human.skeleton, posture.q, posture.root)[static_cast<std::size_t>(human.skeleton.link("thigh_left"))]
          .origin;
  EXPECT_EQ(table.columns[static_cast<std::size_t>(table.column("femur_l_force_py"))][0], hip.z);

  std::ifstream stream(folder / "loads.xml");
  const std::string xml(std::istreambuf_iterator<char>(stream), {});
  for (const char* part :
       {"<OpenSimDocument Version=\"40000\">", "<ExternalLoads name=\"a &lt;run&gt; &amp; more\">",
        "<applied_to_body>femur_l</applied_to_body>", "<force_identifier>femur_l_force_v</force_identifier>",
        "<point_identifier>femur_l_force_p</point_identifier>",
        "<torque_identifier>femur_l_torque_</torque_identifier>",
        "<force_expressed_in_body>ground</force_expressed_in_body>", "<datafile>loads.mot</datafile>"})
    EXPECT_NE(xml.find(part), std::string::npos) << part;
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace gambeson
