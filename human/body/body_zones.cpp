#include "human/body/body_zones.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>

#include "human/body/skin.hpp"

namespace gambeson {
namespace {

/// Where the link's joint stands in the frame of `ancestor`, all joints between them at zero; none where it hangs on
/// another branch.
std::optional<Vec3> jointIn(const Skeleton& skeleton, int link, int ancestor) {
  Pose X{};
  while (link != ancestor) {
    const int j = skeleton.links[static_cast<std::size_t>(link)].parent_joint;
    if (j < 0) return {};
    const Joint& joint = skeleton.joints[static_cast<std::size_t>(j)];
    X = joint.X_PJ * X;
    link = joint.parent;
  }
  return X.origin;
}

/// Smallest semi-axis of the link's ellipsoid of the largest volume; 0 where it has none.
double radiusOf(const Human& human, int link) {
  double volume = 0, radius = 0;
  for (const BodyShape& s : human.shapes)
    if (const auto* e = std::get_if<Ellipsoid>(&s.shape); e && s.link == link) {
      const Vec3& a = e->semi_axes;
      if (a.x * a.y * a.z <= volume) continue;
      volume = a.x * a.y * a.z;
      radius = std::min({a.x, a.y, a.z});
    }
  return radius;
}

/// Unit, from the link's origin towards where the next link hangs, or down.
Vec3 lengthwise(const Skeleton& skeleton, int link) {
  for (const Joint& j : skeleton.joints)
    if (j.parent == link && norm(j.X_PJ.origin) > 0) return normalized(j.X_PJ.origin);
  return {0, 0, -1};
}

}  // namespace

int BodyZones::add(const std::string& name) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found != names_.end()) return static_cast<int>(found - names_.begin());
  names_.push_back(name);
  return static_cast<int>(names_.size()) - 1;
}

BodyZones::BodyZones(const Human& human) : zone_(human.skeleton.links.size(), -1) {
  const Skeleton& skeleton = human.skeleton;
  std::vector<char> surfaced(skeleton.links.size(), 0);
  for (const BodyShape& s : human.shapes) surfaced[static_cast<std::size_t>(s.link)] = 1;
  if (human.skin)
    for (const int l : human.skin->segment) surfaced[static_cast<std::size_t>(l)] = 1;
  std::set<int> links;
  for (std::size_t l = 0; l < surfaced.size(); ++l)
    if (surfaced[l]) links.insert(static_cast<int>(l));
  const int torso = skeleton.link("torso");
  arm_[0] = skeleton.link("upper_arm_left");
  arm_[1] = skeleton.link("upper_arm_right");
  if (torso >= 0 && arm_[0] >= 0 && arm_[1] >= 0 && links.contains(torso)) {
    const std::optional<Vec3> l = jointIn(skeleton, arm_[0], torso), r = jointIn(skeleton, arm_[1], torso);
    if (l && r && norm(*l - *r) > 0) {
      middle_ = 0.5 * (*l + *r);
      left_ = normalized(*l - *r);
      const Vec3 up = middle_ - dot(middle_, left_) * left_;
      if (norm(up) > 0) torso_ = torso, up_ = normalized(up);
    }
  }
  // From head to foot.
  if (const int head = skeleton.link("head"); head >= 0 && links.contains(head))
    zone_[static_cast<std::size_t>(head)] = add("head");
  if (torso_ >= 0) {
    double arm = 0;
    for (int k = 0; k < 2; ++k) {
      arm = std::max(arm, radiusOf(human, arm_[k]));
      along_[k] = lengthwise(skeleton, arm_[k]);
      shoulder_[k] = add(k == 0 ? "shoulder_left" : "shoulder_right");
    }
    armpit_m_ = arm > 0 ? arm : kArmOfStature * human.stature_m;
    chest_ = zone_[static_cast<std::size_t>(torso_)] = add("chest");
    waist_ = add("waist");
  }
  const int pelvis = skeleton.link("pelvis");
  if (pelvis >= 0 && links.contains(pelvis)) zone_[static_cast<std::size_t>(pelvis)] = add("hips");
  for (const char* part : {"thigh", "shank", "foot", "upper_arm", "forearm", "hand"})
    for (const char* side : {"_left", "_right"})
      if (const int l = skeleton.link(std::string(part) + side); l >= 0 && links.contains(l))
        zone_[static_cast<std::size_t>(l)] = add(std::string(part) + side);
  for (const int l : links)
    if (zone_[static_cast<std::size_t>(l)] < 0)
      zone_[static_cast<std::size_t>(l)] = add(skeleton.links[static_cast<std::size_t>(l)].name);
}

int BodyZones::of(int link, const Vec3& p) const {
  const int zone = zone_.at(static_cast<std::size_t>(link));
  if (zone < 0) throw std::logic_error("a link without surface was touched");
  if (torso_ < 0) return zone;
  if (link == torso_) {
    const double height = dot(p - middle_, up_), aside = dot(p - middle_, left_);
    if (height > -armpit_m_ && std::abs(aside) > kMedian_m) return shoulder_[aside > 0 ? 0 : 1];
    return dot(p, up_) < kWaistShare * dot(middle_, up_) ? waist_ : chest_;
  }
  for (int k = 0; k < 2; ++k)
    if (link == arm_[k] && dot(p, along_[k]) < armpit_m_) return shoulder_[k];
  return zone;
}

std::vector<int> BodyZones::ofSkin(const Skin& skin) const {
  std::vector<int> zones;
  for (std::size_t v = 0; v < skin.rest.vertices.size(); ++v)
    zones.push_back(
        of(skin.segment[v], inverse(skin.bind[static_cast<std::size_t>(skin.segment[v])]) * skin.rest.vertices[v]));
  return zones;
}

}  // namespace gambeson
