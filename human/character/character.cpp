#include "human/character/character.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include "core/error.hpp"
#include "human/body/skin.hpp"
#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/skeleton/joint_map.hpp"
#include "human/skeleton/limb_angles.hpp"

namespace gambeson {
namespace {

constexpr double kDensity_kg_per_m3 = 1000;
constexpr double kLeastHeight_m = 0.5, kMostHeight_m = 3;
/// Part of the hinge's side in an elbow's axis beside the plane of the bent arm: at more than 6 degrees that decides.
constexpr double kElbowShare = 0.1;

Vec3 across(const Vec3& v, const Vec3& unit) { return v - dot(v, unit) * unit; }

/// Joints of the body by name (thigh_left: the hip, ...), in our axes and metres.
using Joints = std::map<std::string, Vec3>;

std::string lower(std::string s) {
  for (char& c : s) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

class Fit {
 public:
  /// `ours`: bones are named as our links.
  Fit(const CharacterOptions& o, RiggedMesh body, bool ours, CharacterReport& report)
      : o_(o), body_(std::move(body)), report_(report), human_(makeManikin(o.like)) {
    report_.notes = body_.notes;
    if (ours)
      for (std::size_t b = 0; b < body_.bones.size(); ++b) anchor_[body_.bones[b].name] = static_cast<int>(b);
    else
      findBones();
    stand();
    joints();
    lengths();
    bind();
    skin();
    masses();
    shapes();
    human_.skin = std::make_shared<const Skin>(std::move(skin_));
  }
  Human take() { return std::move(human_); }

 private:
  [[noreturn]] void fail(const std::string& key, const std::string& reason) const {
    throw InputError({body_.file, 0, key}, reason);
  }

  void findBones() {
    std::vector<std::string> names;
    for (const RiggedBone& b : body_.bones) names.push_back(b.name);
    std::vector<JointMap> maps;
    if (o_.map.empty())
      maps = mapsFor({MapKind::bones}, names);
    else
      maps.push_back(findJointMap(o_.map));
    if (maps.empty()) {
      const auto shown = names.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(names.size(), 12));
      fail("map", fmt::format("no map that ships goes with its bones ({}{}): name one of your own as \"map\"",
                              fmt::join(names.begin(), shown, ", "), shown == names.end() ? "" : ", ..."));
    }
    const JointMap& m = maps.front();
    if (m.kind != MapKind::bones) fail("map", fmt::format("'{}' does not read bones", o_.map));
    report_.map = m.name;
    const auto add = [&](const std::string& link, const Points& names_of, const std::string& key) {
      if (names_of.size() != 1) fail(key, "of the map '" + m.name + "' must be one bone for a character");
      const int b = body_.find(names_of[0]);
      if (b < 0) fail(key, "the character has no bone '" + names_of[0] + "'; the map '" + m.name + "' asks for it");
      anchor_[link] = b;
    };
    add("pelvis", {m.pelvis_joint}, "pelvis.joint");
    if (m.torso_joint.empty()) fail("torso", "is missing in the map '" + m.name + "': a character needs it");
    add("torso", m.torso_bone[0], "torso.bone[0]");
    add("head", m.torso_bone[1], "torso.bone[1]");
    for (const char* side : {"_left", "_right"}) {
      const auto bone = [&](const char* segment, int end) -> const Points& {
        const auto at = m.bones.find(std::string(segment) + side);
        if (at == m.bones.end())
          fail(std::string("bones.") + segment + side, "is missing in the map '" + m.name + "': a character needs it");
        return at->second[static_cast<std::size_t>(end)];
      };
      const auto key = [&](const char* segment, int end) { return fmt::format("bones.{}{}[{}]", segment, side, end); };
      for (const char* segment : {"thigh", "shank", "foot", "upper_arm", "forearm"})
        add(std::string(segment) + side, bone(segment, 0), key(segment, 0));
      add(std::string("hand") + side, bone("forearm", 1), key("forearm", 1));
      add(std::string("toes") + side, bone("foot", 1), key("foot", 1));
    }
  }

  Vec3 head(const std::string& link) const { return body_.bones[static_cast<std::size_t>(anchor_.at(link))].head; }

  /// Turns and scales the body to our axes and metres: hips at x = y = 0, the lowest point at z = 0.
  void stand() {
    const Vec3 hips = 0.5 * (head("thigh_left") + head("thigh_right"));
    const auto snapped = [&](const Vec3& d, const char* what) {
      int k = 0;
      for (int i = 1; i < 3; ++i)
        if (std::abs(d[i]) > std::abs(d[k])) k = i;
      Vec3 a;
      a[k] = d[k] > 0 ? 1 : -1;
      if (!(dot(a, d) > 0.9 * norm(d)))
        fail("pose", fmt::format("the body does not stand along an axis of the file: its bones tell no {}", what));
      return a;
    };
    const Vec3 up = snapped(head("head") - hips, "up");
    const Vec3 left = snapped(head("thigh_left") - head("thigh_right"), "left");
    if (dot(up, left) != 0) fail("pose", "the hips stand above each other");
    const Vec3 forward = cross(left, up);
    const Vec3 toes = head("toes_left") + head("toes_right") - head("foot_left") - head("foot_right");
    if (!(dot(toes, forward) > 0)) fail("map", "left and right are confused: the toes point backward");
    const Mat3 R = axesOf(forward, up);

    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Vec3& x : body_.mesh.vertices) {
      low = std::min(low, dot(up, x));
      high = std::max(high, dot(up, x));
    }
    double scale = body_.unit_m;
    if (o_.height_m) scale = *o_.height_m / (high - low);
    report_.height_m = scale * (high - low);
    if (!(report_.height_m > kLeastHeight_m && report_.height_m < kMostHeight_m))
      fail("height",
           fmt::format("the body is {:.3g} m tall by the file's unit; say what it should be", report_.height_m));
    const auto move = [&](Vec3& x) {
      x = scale * (R * (x - hips));
      x.z += scale * (dot(up, hips) - low);
    };
    for (Vec3& x : body_.mesh.vertices) move(x);
    for (RiggedBone& b : body_.bones) move(b.head);
  }

  void joints() {
    for (const auto& [link, bone] : anchor_) at_[link] = head(link);
    const auto apart = [&](const std::string& a, const std::string& b) {
      if (!(norm(at_[a] - at_[b]) > 0.02 * report_.height_m))
        fail("map", fmt::format("the bones of {} and {} start at the same place", a, b));
    };
    for (const std::string side : {"_left", "_right"}) {
      apart("thigh" + side, "shank" + side);
      apart("shank" + side, "foot" + side);
      apart("foot" + side, "toes" + side);
      apart("upper_arm" + side, "forearm" + side);
      apart("forearm" + side, "hand" + side);
    }
    apart("torso", "head");
  }

  int joint(const std::string& name) const { return human_.skeleton.joint(name); }
  Vec3& offset(const std::string& joint_name) {
    return human_.skeleton.joints[static_cast<std::size_t>(joint(joint_name))].X_PJ.origin;
  }

  /// Joint values of the file's pose, and where each joint sits in its parent link.
  void lengths() {
    q_.assign(human_.skeleton.joints.size(), 0.0);
    root_.origin = 0.5 * (at_["thigh_left"] + at_["thigh_right"]);
    offset("lumbar_flexion") = at_["torso"] - root_.origin;
    offset("neck_flexion") = at_["head"] - at_["torso"];
    double arms = 0;
    for (const std::string side : {"_left", "_right"}) {
      offset("hip_flexion" + side) = at_["thigh" + side] - root_.origin;
      offset("shoulder_flexion" + side) = at_["upper_arm" + side] - at_["torso"];
      leg(side);
      arm(side);
      const Vec3 upper = normalized(at_["forearm" + side] - at_["upper_arm" + side]);
      arms += 0.5 * std::acos(std::clamp(-upper.z, -1.0, 1.0)) / rad_per_deg;
    }
    report_.arms_deg = arms;
    report_.pose = arms > 70 ? 'T' : 'A';
  }

  std::array<Vec3, 3> axesAt(const std::array<std::string, 3>& names) const {
    std::array<Vec3, 3> e;
    for (std::size_t k = 0; k < 3; ++k) e[k] = human_.skeleton.joints[static_cast<std::size_t>(joint(names[k]))].axis;
    return e;
  }
  void setBall(const std::array<std::string, 3>& names, const Mat3& R) {
    const auto angles = threeAngles(R, axesAt(names));
    for (std::size_t k = 0; k < 3; ++k) q_[static_cast<std::size_t>(joint(names[k]))] = angles[k];
  }
  double& value(const std::string& name) { return q_[static_cast<std::size_t>(joint(name))]; }
  Mat3 turn(const std::string& name) const {
    const auto j = static_cast<std::size_t>(joint(name));
    return rotationAbout(human_.skeleton.joints[j].axis, q_[j]);
  }

  void leg(const std::string& side) {
    const Vec3 hip = at_["thigh" + side], knee = at_["shank" + side], ankle = at_["foot" + side],
               toes = at_["toes" + side];
    // The knee's axis is level across the foot; what the shank leans sideways stays in its bone.
    const Vec3 heading = across(toes - ankle, {0, 0, 1});
    if (!(norm(heading) > 0.2 * norm(toes - ankle))) fail("pose", fmt::format("the foot{} points straight down", side));
    const Vec3 z = normalized(hip - knee), y = normalized(across(cross({0, 0, 1}, heading), z));
    const Mat3 thigh{cross(y, z), y, z};
    setBall({"hip_flexion" + side, "hip_adduction" + side, "hip_rotation" + side}, thigh);
    offset("knee_flexion" + side) = {0, 0, -norm(knee - hip)};
    const Vec3 down = transposeTimes(thigh, ankle - knee);
    value("knee_flexion" + side) = std::atan2(-down.x, -down.z);
    const Mat3 shank = thigh * turn("knee_flexion" + side);
    offset("ankle_flexion" + side) = transposeTimes(shank, ankle - knee);
    const Vec3 up = transposeTimes(shank, {0, 0, 1});
    value("ankle_flexion" + side) = std::atan2(-up.x, up.z);
  }

  void arm(const std::string& side) {
    const Vec3 shoulder = at_["upper_arm" + side], elbow = at_["forearm" + side], wrist = at_["hand" + side];
    const Vec3 z = normalized(shoulder - elbow), fore = normalized(wrist - elbow);
    const Vec3 hinge = shortestTurn({0, 0, -1}, -z) * Vec3{0, -1, 0};
    const Vec3 y = -normalized(across(cross(-z, fore) + kElbowShare * hinge, z));
    const Mat3 upper{cross(y, z), y, z};
    setBall({"shoulder_flexion" + side, "shoulder_abduction" + side, "shoulder_rotation" + side}, upper);
    offset("elbow_flexion" + side) = {0, 0, -norm(elbow - shoulder)};
    const Vec3 down = transposeTimes(upper, wrist - elbow);
    value("elbow_flexion" + side) = std::atan2(down.x, -down.z);
    const Mat3 forearm = upper * turn("elbow_flexion" + side);
    offset("wrist" + side) = transposeTimes(forearm, wrist - elbow);
  }

  void bind() {
    skin_.bind = linkPoses(human_.skeleton, q_, root_);
    for (const auto& [link, x] : at_) {
      const int l = human_.skeleton.link(link);
      if (l > 0 && norm(skin_.bind[static_cast<std::size_t>(l)].origin - x) > 1e-6)
        throw RunError("character: the joint of " + link + " is not where its bone starts");
    }
  }

  /// The link that each bone moves with.
  std::vector<int> linksOfBones() const {
    std::vector<int> of(body_.bones.size(), 0);
    for (std::size_t b = 0; b < of.size(); ++b) {
      if (body_.bones[b].parent >= 0) of[b] = of[static_cast<std::size_t>(body_.bones[b].parent)];
      for (const auto& [link, bone] : anchor_)
        if (bone == static_cast<int>(b) && !link.starts_with("toes")) of[b] = human_.skeleton.link(link);
    }
    return of;
  }

  void skin() {
    const std::vector<int> of = linksOfBones();
    skin_.rest = body_.mesh;
    skin_.first = {0};
    for (std::size_t v = 0; v + 1 < body_.first.size(); ++v) {
      std::map<int, double> sum;
      for (int i = body_.first[v]; i < body_.first[v + 1]; ++i)
        sum[of[static_cast<std::size_t>(body_.bone[static_cast<std::size_t>(i)])]] +=
            body_.weight[static_cast<std::size_t>(i)];
      int best = sum.begin()->first;
      for (const auto& [l, w] : sum) {
        skin_.link.push_back(l);
        skin_.weight.push_back(w);
        if (w > sum[best]) best = l;
      }
      skin_.segment.push_back(body_.part.empty() ? best : of[static_cast<std::size_t>(body_.part[v])]);
      skin_.first.push_back(static_cast<int>(skin_.link.size()));
    }
  }

  double volume() const {
    double v = 0;
    const auto& x = skin_.rest.vertices;
    for (const auto& t : skin_.rest.triangles) v += dot(x[t[0]], cross(x[t[1]], x[t[2]])) / 6;
    return v;
  }

  /// Shares of mass and places of its centres along the limbs as in the manikin; in trunk and head they grow with
  /// stature.
  void masses() {
    report_.volume_m3 = volume();
    const Human like = makeManikin(o_.like);
    const double mass = o_.mass_kg.value_or(kDensity_kg_per_m3 * report_.volume_m3), scale = mass / like.mass_kg,
                 taller = report_.height_m / like.stature_m;
    human_.mass_kg = mass;
    human_.stature_m = report_.height_m;
    for (std::size_t l = 0; l < human_.skeleton.links.size(); ++l) {
      Link& link = human_.skeleton.links[l];
      link.mass_kg *= scale;
      double longer = taller;
      for (std::size_t j = 0; j < human_.skeleton.joints.size(); ++j) {
        const Joint& mine = human_.skeleton.joints[j];
        const bool limb = link.name.starts_with("thigh") || link.name.starts_with("shank") ||
                          link.name.starts_with("upper_arm") || link.name.starts_with("forearm");
        if (limb && link.mass_kg > 0 && mine.parent == static_cast<int>(l))
          longer = norm(mine.X_PJ.origin) / norm(like.skeleton.joints[j].X_PJ.origin);
      }
      link.center_of_mass *= longer;
    }
  }

  /// An ellipsoid in each link's frame that fills the box of its part of the skin: feet stand on theirs, and the
  /// shapes' axes say where the skin shrinks to while a garment is put on.
  void shapes() {
    human_.shapes.clear();
    for (std::size_t l = 0; l < human_.skeleton.links.size(); ++l) {
      constexpr double inf = std::numeric_limits<double>::infinity();
      Vec3 low{inf, inf, inf}, high = -low;
      const Pose X_LW = inverse(skin_.bind[l]);
      for (std::size_t v = 0; v < skin_.segment.size(); ++v) {
        if (skin_.segment[v] != static_cast<int>(l)) continue;
        const Vec3 x = X_LW * skin_.rest.vertices[v];
        for (int k = 0; k < 3; ++k) low[k] = std::min(low[k], x[k]), high[k] = std::max(high[k], x[k]);
      }
      const std::string& name = human_.skeleton.links[l].name;
      if (!(high.x > low.x)) {
        if (anchor_.contains(name)) fail("weights", "no part of the body moves with the bone of " + name);
        continue;
      }
      human_.shapes.push_back({static_cast<int>(l), name, Ellipsoid{0.5 * (high - low)}, {{}, 0.5 * (high + low)}});
    }
  }

  const CharacterOptions& o_;
  RiggedMesh body_;
  CharacterReport& report_;
  Human human_;
  Skin skin_;
  std::map<std::string, int> anchor_;  ///< link (and toes_left, ...) -> bone
  Joints at_;
  std::vector<double> q_;
  Pose root_;
};

}  // namespace

Human loadCharacter(const CharacterOptions& o, CharacterReport* report) {
  CharacterReport mine;
  const std::string file = o.file.string();
  const bool makehuman = lower(o.file.extension().string()) == ".obj";
  for (const auto& [path, key] : {std::pair{o.skeleton, "skeleton"}, {o.weights, "weights"}}) {
    if (makehuman && path.empty()) throw InputError({file, 0, key}, "is required for MakeHuman's mesh (.obj)");
    if (!makehuman && !path.empty()) throw InputError({file, 0, key}, "goes with MakeHuman's mesh (.obj) only");
  }
  if (!makehuman && !o.targets.empty()) throw InputError({file, 0, "targets"}, "go with MakeHuman's mesh (.obj) only");
  const RiggedMesh whole =
      makehuman ? readMakeHuman({o.file, o.skeleton, o.weights, o.targets, "body"}) : readRiggedScene(o.file);
  return Fit(o, bodyOf(whole), false, report ? *report : mine).take();
}

Human characterOf(RiggedMesh body, const CharacterOptions& o, CharacterReport* report) {
  CharacterReport mine;
  return Fit(o, std::move(body), true, report ? *report : mine).take();
}

}  // namespace gambeson
