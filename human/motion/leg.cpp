#include "human/motion/leg.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "human/body/ground.hpp"
#include "human/skeleton/limb_angles.hpp"

namespace gambeson {
namespace {

/// Columns: x, across the plane of the leg (to the left), up in it.
Mat3 planeOf(const Vec3& hip, const Vec3& ankle) {
  const Vec3 x{1, 0, 0}, across = normalized(cross(x, ankle - hip));
  return {x, across, cross(x, across)};
}

/// A link's length and its direction at the joint value 0, forward from straight down.
struct Link2 {
  double length, angle;
  explicit Link2(const Vec3& end) : length(std::hypot(end.x, end.z)), angle(std::atan2(end.x, -end.z)) {}
};

}  // namespace

double Leg::length_m() const { return norm(knee_T) + norm(ankle_S); }

LegAngles Leg::anglesOf(const Posture& posture) const {
  LegAngles a{};
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = posture.q[static_cast<std::size_t>(joints[k])];
  return a;
}

void Leg::set(const LegAngles& angles, Posture& posture) const {
  for (std::size_t k = 0; k < angles.size(); ++k) posture.q[static_cast<std::size_t>(joints[k])] = angles[k];
}

Leg legOf(const Human& human, const std::string& side, const std::string& what) {
  const Skeleton& s = human.skeleton;
  Leg leg;
  const std::array<const char*, 5> names{"hip_flexion", "hip_adduction", "hip_rotation", "knee_flexion",
                                         "ankle_flexion"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    leg.joints[k] = s.joint(std::string(names[k]) + "_" + side);
    if (leg.joints[k] < 0)
      throw InputError({"", 0, "human"}, what + " needs the joint '" + names[k] + "_" + side + "'");
  }
  const auto joint = [&](std::size_t k) -> const Joint& { return s.joints[static_cast<std::size_t>(leg.joints[k])]; };
  for (const std::size_t k : {std::size_t{1}, std::size_t{2}})
    if (norm(joint(k).X_PJ.origin) > 1e-9 || std::abs(dot(joint(k).axis, joint(0).axis)) > 1e-9 ||
        std::abs(dot(joint(1).axis, joint(2).axis)) > 1e-9)
      throw InputError({"", 0, joint(k).name}, what +
                                                   " needs hips whose three axes meet in one point, each across the "
                                                   "others");
  leg.hip_P = joint(0).X_PJ.origin;
  leg.knee_T = joint(3).X_PJ.origin;
  leg.ankle_S = joint(4).X_PJ.origin;
  leg.foot = &footOf(human, side, what);
  return leg;
}

Mat3 footRotation(const Vec3& hip_W, const Vec3& ankle_W, double pitch) {
  return planeOf(hip_W, ankle_W) * rotationAbout({0, 1, 0}, -pitch);
}

std::optional<LegAngles> reach(const Human& human, const Leg& leg, const Pose& pelvis, const Vec3& ankle_W,
                               double pitch) {
  const Vec3 hip_W = pelvis * leg.hip_P, way = ankle_W - hip_W;
  const Mat3 plane = planeOf(hip_W, ankle_W);
  const double forward = dot(way, plane.a), down = -dot(way, plane.c);
  const Link2 thigh(leg.knee_T), shank(leg.ankle_S);
  const double a = thigh.length, b = shank.length;
  const double sideways = leg.knee_T.y + leg.ankle_S.y;  // of bones that lean; the foot is off by as much
  const double cosine = (forward * forward + down * down - sideways * sideways - a * a - b * b) / (2 * a * b);
  if (!(cosine <= 1 + 1e-12 && cosine >= -1)) return std::nullopt;
  const double bend = std::acos(std::min(cosine, 1.0));
  const double turned = std::atan2(forward, down) + std::atan2(b * std::sin(bend), a + b * std::cos(bend)) -
                        thigh.angle;  // of the thigh's frame, forward
  const double knee = bend - thigh.angle + shank.angle;
  const auto axis = [&](std::size_t k) { return human.skeleton.joints[static_cast<std::size_t>(leg.joints[k])].axis; };
  const Mat3 thigh_P = transpose(pelvis.rotation) * plane * rotationAbout({0, 1, 0}, -turned);
  const auto hip = threeAngles(thigh_P, {axis(0), axis(1), axis(2)});
  return LegAngles{hip[0], hip[1], hip[2], knee, pitch - turned + knee};
}

}  // namespace gambeson
