/// Parts of the body: landmarks of the manikins, both sides alike, the skin as the ellipsoids.

#include "human/body/body_zones.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "human/body/body_file.hpp"
#include "human/body/skin.hpp"
#include "human/manikin/manikin.hpp"
#include "human/skin/make_skin.hpp"

namespace gambeson {
namespace {

std::string zoneAt(const Human& human, const char* link, const Vec3& p) {
  const BodyZones zones(human);
  return zones.names()[static_cast<std::size_t>(zones.of(human.skeleton.link(link), p))];
}

TEST(Zones, LandmarksOfTheManikins) {
  for (const std::string& name : manikinNames()) {
    const Human human = makeManikin(name);
    const Skeleton& k = human.skeleton;
    const Vec3 shoulder = k.joints[static_cast<std::size_t>(k.joint("shoulder_flexion_left"))].X_PJ.origin;  // in torso
    double arm = 0;
    for (const BodyShape& s : human.shapes)
      if (s.name == "shoulder_left") arm = std::get<Ellipsoid>(s.shape).semi_axes.x;
    ASSERT_GT(arm, 0.03) << name;
    const auto torso = [&](double aside, double height) { return zoneAt(human, "torso", {shoulder.x, aside, height}); };
    // The armpit lies an arm's radius below the joint.
    EXPECT_EQ(torso(0.08, shoulder.z - arm + 1e-3), "shoulder_left") << name;
    EXPECT_EQ(torso(-0.08, shoulder.z - arm + 1e-3), "shoulder_right") << name;
    EXPECT_EQ(torso(0.08, shoulder.z - arm - 1e-3), "chest") << name;
    EXPECT_EQ(torso(0, shoulder.z), "chest") << name;
    EXPECT_EQ(torso(0.1, 0.4 * shoulder.z + 1e-3), "chest") << name;
    EXPECT_EQ(torso(0.1, 0.4 * shoulder.z - 1e-3), "waist") << name;
    EXPECT_EQ(zoneAt(human, "upper_arm_left", {0, 0, 0.5 * arm}), "shoulder_left") << name;
    EXPECT_EQ(zoneAt(human, "upper_arm_right", {0, 0, -arm + 1e-3}), "shoulder_right") << name;
    EXPECT_EQ(zoneAt(human, "upper_arm_right", {0, 0, -arm - 1e-3}), "upper_arm_right") << name;
    EXPECT_EQ(zoneAt(human, "pelvis", {0, 0, 0}), "hips") << name;
    EXPECT_EQ(zoneAt(human, "thigh_right", {0, 0, -0.2}), "thigh_right") << name;
    EXPECT_EQ(zoneAt(human, "head", {0, 0, 0.1}), "head") << name;
    // The natural waist of the data lies in the waist, the chest's largest section in the chest.
    for (const BodyShape& s : human.shapes) {
      if (s.name != "waist" && s.name != "chest") continue;
      EXPECT_EQ(zoneAt(human, "torso", s.X_LS.origin), s.name) << name;
    }
  }
}

TEST(Zones, TheSkinIsSharedOutAlikeOnBothSides) {
  Human human = makeManikin("male_p50");
  human.skin = std::make_shared<const Skin>(makeSkin(human, {0.016, 0.003}));
  const BodyZones zones(human);
  const std::vector<int> of = zones.ofSkin(*human.skin);
  std::vector<int> count(zones.names().size());
  for (const int z : of) ++count[static_cast<std::size_t>(z)];
  const auto number = [&](const std::string& zone) {
    const auto at = std::find(zones.names().begin(), zones.names().end(), zone);
    return at == zones.names().end() ? -1 : count[static_cast<std::size_t>(at - zones.names().begin())];
  };
  for (const char* part : {"shoulder", "thigh", "shank", "upper_arm", "forearm"}) {
    EXPECT_GT(number(std::string(part) + "_left"), 100) << part;
    EXPECT_EQ(number(std::string(part) + "_left"), number(std::string(part) + "_right")) << part;
  }
  EXPECT_GT(number("waist"), 100);
  EXPECT_GT(number("chest"), 100);
  EXPECT_GT(number("hips"), 100);
}

TEST(Zones, WithoutATorsoTheLinksAreTheZones) {
  const Human arm =
      loadHuman(GAMBESON_SOURCE_DIR "/cases/library/arm.urdf", GAMBESON_SOURCE_DIR "/cases/library/arm_body.json");
  const BodyZones zones(arm);
  EXPECT_EQ(zones.names(), (std::vector<std::string>{"upper_arm", "forearm"}));
  EXPECT_EQ(zones.of(arm.skeleton.link("forearm"), {0, 0, 1}), 1);
}

}  // namespace
}  // namespace gambeson
