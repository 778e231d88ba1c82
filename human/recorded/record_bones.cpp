/// Detail of captured_motion.hpp: A hierarchy of bones as a captured motion: matched by the directions of bones in the
/// world, so that the pose in which the hierarchy was written down (T, A, arms down) does not matter for limbs. Pelvis,
/// head and the twist of the trunk have no bone that shows them: they turn as their joints do from the rest pose, which
/// stands upright.

#include <fmt/format.h>

#include "core/error.hpp"
#include "human/motion/standing.hpp"
#include "human/recorded/captured_motion.hpp"

namespace gambeson {
namespace {

int need(const BvhClip& clip, const std::string& name, const std::string& map) {
  const int j = clip.joint(name);
  if (j < 0) throw InputError({clip.file, 0, name}, "is missing in the file; the map '" + map + "' asks for it");
  return j;
}

/// Where a foot's bone ends: at its joint, or, where the file has none, at the end site of the one where it begins.
int toesOf(const BvhClip& clip, const std::array<Points, 2>& foot, const std::string& map) {
  if (clip.joint(foot[1].front()) < 0)
    if (const int end = clip.endSite(need(clip, foot[0].front(), map)); end >= 0) return end;
  return need(clip, foot[1].front(), map);
}

Vec3 across(const Vec3& v, const Vec3& unit) { return v - dot(v, unit) * unit; }

/// A frame whose third column is `up` and whose second is near `left`.
Mat3 uprightFrame(const Vec3& up, const Vec3& left) {
  const Vec3 y = normalized(across(left, up));
  return {cross(y, up), y, up};
}

Vec3 meanOf(const BvhClip& clip, const std::vector<Pose>& X, const Points& names, const std::string& map) {
  Vec3 sum;
  for (const std::string& n : names) sum += X[need(clip, n, map)].origin;
  return sum / static_cast<double>(names.size());
}

}  // namespace

void addDirections(CapturedMotion& r, const Human& human, const LimbJoints& joints, const BodyDirections& body) {
  std::vector<double> q = r.q.empty() ? standing(human).q : r.q.back();
  setDirections(human.skeleton, joints, body, q);
  r.q.push_back(std::move(q));
  r.hips.push_back(body.hips);
  r.pelvis.push_back(body.pelvis);
  if (!r.driven.empty()) return;
  r.driven.assign(human.skeleton.joints.size(), false);
  const auto drive = [&](int j) {
    if (j >= 0) r.driven[j] = true;
  };
  for (int side = 0; side < 2; ++side) {
    for (const int j : joints.hip[side]) drive(j);
    drive(joints.knee[side]);
    if (body.foot[side]) drive(joints.ankle[side]);
    if (body.arm[side]) {
      for (const int j : joints.shoulder[side]) drive(j);
      drive(joints.elbow[side]);
    }
  }
  if (body.torso)
    for (const int j : joints.lumbar) drive(j);
  if (body.head) drive(joints.neck);
}

BodyDirections boneDirections(const BvhClip& clip, const JointMap& map, const std::vector<double>& frame,
                              const Mat3& to_ours) {
  const std::vector<Pose> X = bvhPoses(clip, frame, map.position_adds);
  const Mat3 body = axesOf(map.forward, map.up);
  const auto turned = [&](const std::string& joint) {
    return to_ours * X[need(clip, joint, map.name)].rotation * transpose(body);
  };
  const auto direction = [&](const std::array<Points, 2>& ends) {
    const Vec3 d = to_ours * (meanOf(clip, X, ends[1], map.name) - meanOf(clip, X, ends[0], map.name));
    if (!(norm(d) > 0)) throw InputError({clip.file, 0, ends[0].front()}, "and " + ends[1].front() + " coincide");
    return normalized(d);
  };
  BodyDirections b;
  const Vec3 right = meanOf(clip, X, map.hips[0], map.name), left = meanOf(clip, X, map.hips[1], map.name);
  b.hips = map.unit_m * (to_ours * (0.5 * (right + left)));
  const Vec3 y = direction({map.hips[0], map.hips[1]});
  const Vec3 up = normalized(across(turned(map.pelvis_joint).c, y));
  b.pelvis = {cross(y, up), y, up};
  b.torso = map.torso_joint.empty() ? b.pelvis : uprightFrame(direction(map.torso_bone), turned(map.torso_joint).b);
  if (!map.head_joint.empty()) b.head = turned(map.head_joint);
  std::vector<double> rest(frame.size());
  for (int side = 0; side < 2; ++side) {
    const auto bone = [&](const char* segment) -> const std::array<Points, 2>* {
      const auto found = map.bones.find(sided(segment, side));
      return found == map.bones.end() ? nullptr : &found->second;
    };
    const auto* thigh = bone("thigh");
    b.leg[side] = {direction(*thigh), direction(*bone("shank")), turned((*thigh)[0].front()).b};
    // The sole is flat in the rest pose: the foot's bone, level, turned as its joint.
    const auto* foot = bone("foot");
    Vec3 toes{};
    for (int j = toesOf(clip, *foot, map.name); j != need(clip, (*foot)[0].front(), map.name);
         j = clip.joints[j].parent) {
      if (clip.joints[j].parent < 0)
        throw InputError({clip.file, 0, (*foot)[1].front()}, "does not hang from " + (*foot)[0].front());
      toes += clip.joints[j].offset;
    }
    const Vec3 level = across(body * toes, {0, 0, 1});
    if (!(norm(level) > 0)) throw InputError({clip.file, 0, (*foot)[0].front()}, "its bone points straight down");
    b.foot[side] = turned((*foot)[0].front()) * normalized(level);
    if (bone("upper_arm") && bone("forearm")) {
      const Vec3 upper = direction(*bone("upper_arm"));
      const Mat3 hanging = shortestTurn(-b.torso->c, upper) * *b.torso;
      b.arm[side] = LimbDirections{upper, direction(*bone("forearm")), -hanging.b};
    }
  }
  return b;
}

CapturedMotion recordBones(const BvhClip& clip, const JointMap& map, const Human& human,
                           const std::optional<WorldAxes>& world) {
  if (clip.frames.size() < 2)
    throw InputError({clip.file, 0, ""}, "holds a single frame: a pose, not a motion; at least two frames are needed");
  const LimbJoints joints = limbJoints(human.skeleton);
  const Mat3 to_ours = world ? axesOf(world->forward, world->up) : axesOf(map.forward, map.up);
  CapturedMotion r;
  r.file = clip.file, r.map = map.name, r.notes = clip.notes;
  for (std::size_t i = 0; i < clip.frames.size(); ++i) {
    r.times.push_back(static_cast<double>(i) * clip.frame_time_s);
    addDirections(r, human, joints, boneDirections(clip, map, clip.frames[i], to_ours));
  }
  const std::vector<double> rest(clip.frames.front().size());
  const auto X = bvhPoses(clip, rest, true);
  const auto length = [&](const char* bone) {
    const auto& ends = map.bones.at(bone);
    return map.unit_m * norm(meanOf(clip, X, ends[1], map.name) - meanOf(clip, X, ends[0], map.name));
  };
  r.leg_m = 0.5 * (length("thigh_right") + length("shank_right") + length("thigh_left") + length("shank_left"));
  return r;
}

}  // namespace gambeson
