#pragma once
/// A character made from our own manikin, so that all of it is known: its skin in a T- or A-pose, bound linearly.

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "human/body/skin.hpp"
#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "human/skin/make_skin.hpp"
#include "unit/human/character/gltf.hpp"

namespace gambeson::test {

struct CharacterBody {
  Human human;  ///< whose limbs are straight: knees and ankles right under the hips
  Posture pose;
  std::vector<GltfBone> bones;  ///< Unreal's names
  TriangleMesh skin;
  std::vector<std::vector<std::pair<int, double>>> weights;  ///< of bones

  GltfPart part() const { return {"Body", skin, weights}; }
};

/// `arms_deg` from hanging down.
inline CharacterBody characterBody(double arms_deg, double cell_m = 0.035) {
  CharacterBody c{makeManikin("male_p50"), {}, {}, {}, {}};
  Skeleton& s = c.human.skeleton;
  for (Joint& j : s.joints)
    if (j.name.starts_with("knee") || j.name.starts_with("ankle")) j.X_PJ.origin.x = 0;
  Skin skin = makeSkin(c.human, {.cell_m = cell_m});
  c.pose = standing(c.human);
  for (const char* side : {"_left", "_right"})
    c.pose.q[s.joint(std::string("shoulder_abduction") + side)] = arms_deg * rad_per_deg;
  const std::vector<Pose> X = linkPoses(s, c.pose.q, c.pose.root);
  std::vector<int> bone_of(s.links.size(), 0);
  const auto bone = [&](const std::string& name, const std::string& parent, const Vec3& at, const std::string& link) {
    int p = -1;
    for (std::size_t b = 0; b < c.bones.size(); ++b)
      if (c.bones[b].name == parent) p = static_cast<int>(b);
    if (!link.empty()) bone_of[static_cast<std::size_t>(s.link(link))] = static_cast<int>(c.bones.size());
    c.bones.push_back({name, p, at});
  };
  const auto at = [&](const std::string& link) { return X[static_cast<std::size_t>(s.link(link))].origin; };
  const Vec3 hips = 0.5 * (at("thigh_left") + at("thigh_right")), trunk = at("torso"), neck = at("head");
  bone("root", "", {}, "");
  bone("pelvis", "root", hips, "pelvis");
  bone("spine_01", "pelvis", trunk, "torso");
  bone("spine_03", "spine_01", 0.5 * (trunk + neck), "");
  bone("neck_01", "spine_03", neck, "head");
  for (const char* side : {"left", "right"}) {
    const std::string of = std::string("_") + side, l = std::string("_") + side[0];
    bone("thigh" + l, "pelvis", at("thigh" + of), "thigh" + of);
    bone("calf" + l, "thigh" + l, at("shank" + of), "shank" + of);
    bone("foot" + l, "calf" + l, at("foot" + of), "foot" + of);
    bone("ball" + l, "foot" + l, X[s.link("foot" + of)] * Vec3{0.12, 0, 0}, "");
    bone("clavicle" + l, "spine_03", 0.5 * (at("upper_arm" + of) + neck), "");
    bone("upperarm" + l, "clavicle" + l, at("upper_arm" + of), "upper_arm" + of);
    bone("lowerarm" + l, "upperarm" + l, at("forearm" + of), "forearm" + of);
    bone("hand" + l, "lowerarm" + l, at("hand" + of), "hand" + of);
  }
  c.skin.triangles = skin.rest.triangles;
  c.skin.vertices.resize(skin.rest.vertices.size());
  skinPositions(skin, X, c.skin.vertices);
  for (std::size_t v = 0; v < c.skin.vertices.size(); ++v) {
    std::vector<std::pair<int, double>> list;
    for (int i = skin.first[v]; i < skin.first[v + 1]; ++i) list.emplace_back(bone_of[skin.link[i]], skin.weight[i]);
    std::stable_sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    if (list.size() > 4) list.resize(4);
    c.weights.push_back(std::move(list));
  }
  return c;
}

/// A small box that is not the body, bound to one bone.
inline GltfPart box(const Vec3& at, int bone) {
  GltfPart p{"Eye", {}, {}};
  for (int i = 0; i < 8; ++i)
    p.mesh.vertices.push_back(
        at + 0.02 * Vec3{static_cast<double>(i & 1), static_cast<double>(i >> 1 & 1), static_cast<double>(i >> 2)});
  p.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  p.weights.assign(8, {{bone, 1.0}});
  return p;
}

}  // namespace gambeson::test
