#include "human/skeleton/limb_angles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace gambeson {
namespace {

using std::numbers::pi;

/// The axes of three joints that follow each other at one point.
std::array<Vec3, 3> axesOf(const Skeleton& s, const std::array<int, 3>& j) {
  return {s.joints[j[0]].axis, s.joints[j[1]].axis, s.joints[j[2]].axis};
}

/// The right-handed frame of a unit vector and one perpendicular to it.
Mat3 frameOf(const Vec3& a, const Vec3& b) { return {a, b, cross(a, b)}; }

Vec3 perpendicular(const Vec3& v, const Vec3& unit) { return v - dot(v, unit) * unit; }

double nearest(double angle, double to) { return angle + 2 * pi * std::round((to - angle) / (2 * pi)); }

/// Writes three angles, of the two solutions the one nearer to what q holds.
void setBall(const Mat3& R, const std::array<Vec3, 3>& axes, const std::array<int, 3>& joints, std::vector<double>& q) {
  const auto a = threeAngles(R, axes);
  const std::array<double, 3> b{a[0] + pi, pi - a[1], a[2] + pi};
  std::array<double, 3> first{}, second{};
  double d1 = 0, d2 = 0;
  for (int k = 0; k < 3; ++k) {
    const double before = q[joints[k]];
    first[k] = nearest(a[k], before), second[k] = nearest(b[k], before);
    d1 += std::pow(first[k] - before, 2), d2 += std::pow(second[k] - before, 2);
  }
  for (int k = 0; k < 3; ++k) q[joints[k]] = d1 <= d2 ? first[k] : second[k];
}

/// Angle about `axis` that turns `from` to `to`, both projected on the plane across it.
double hingeAngle(const Vec3& from, const Vec3& to, const Vec3& axis) {
  const Vec3 a = perpendicular(from, axis), b = perpendicular(to, axis);
  return std::atan2(dot(cross(a, b), axis), dot(a, b));
}

/// Sets a ball joint and the hinge beyond it; returns the world rotation of the link beyond the hinge. A hinge that
/// `straightens` may pass a little beyond straight, or its lower bone deviate sideways: the plane of the two bones then
/// counts by the cosine between its normal and `hinge`, which keeps its sign however the normal turns, and the less the
/// straighter the limb is, s/(s + weight) with s the sine of the bend.
Mat3 setLimb(const Skeleton& s, const std::array<int, 3>& ball, int hinge, const Mat3& parent, const LimbDirections& d,
             double weight, bool straightens, const Vec3& lower_rest, std::vector<double>& q) {
  const Joint& h = s.joints[hinge];
  // The bone's direction in the upper link; the hinge's axis is across it.
  const Vec3 upper_rest = normalized(h.X_PJ.origin);
  const Vec3 axis = normalized(perpendicular(h.axis, upper_rest));
  Vec3 bend = cross(d.upper, d.lower);
  if (straightens) bend = (dot(bend, d.hinge) / ((norm(bend) + weight) * norm(d.hinge))) * bend;
  const Vec3 wanted = perpendicular(bend + weight * d.hinge, d.upper);
  Vec3 across = wanted;
  if (!(norm(across) > 1e-9)) across = perpendicular(parent * axis, d.upper);
  if (!(norm(across) > 1e-9)) across = perpendicular(Vec3{0.36, 0.48, 0.8}, d.upper);
  const Mat3 upper = frameOf(d.upper, normalized(across)) * transpose(frameOf(upper_rest, axis));
  setBall(transpose(parent) * upper, axesOf(s, ball), ball, q);
  q[hinge] = nearest(hingeAngle(lower_rest, transposeTimes(upper, d.lower), h.axis), q[hinge]);
  return upper * rotationAbout(h.axis, q[hinge]);
}

/// Where the bone of a link ends in its own frame: at the first joint below it.
Vec3 boneOf(const Skeleton& s, int link) {
  for (const Joint& j : s.joints)
    if (j.parent == link && norm(j.X_PJ.origin) > 0) return normalized(j.X_PJ.origin);
  return {0, 0, -1};
}

}  // namespace

Mat3 shortestTurn(const Vec3& a, const Vec3& b) {
  const Vec3 v = cross(a, b);
  const double s = norm(v), c = dot(a, b);
  if (!(s > 1e-12)) return {};
  return rotationAbout(v / s, std::atan2(s, c));
}

LimbJoints limbJoints(const Skeleton& s) {
  LimbJoints j;
  const auto find = [&](const std::string& name, bool needed) {
    const int i = s.joint(name);
    if (i < 0 && needed) throw InputError({"", 0, "human"}, "a recorded motion needs the joint '" + name + "'");
    return i;
  };
  const auto ball = [&](const std::array<int, 3>& b) {
    if (b[0] < 0 || b[1] < 0 || b[2] < 0) return;
    const auto e = axesOf(s, b);
    if (std::abs(dot(e[0], e[1])) > 1e-9 || std::abs(dot(e[1], e[2])) > 1e-9 || std::abs(dot(e[0], e[2])) > 1e-9)
      throw InputError({"", 0, s.joints[b[0]].name},
                       "its axis and those of the two joints after it must be "
                       "perpendicular to be driven by a recorded motion");
  };
  for (int side = 0; side < 2; ++side) {
    const std::string of = side == 0 ? "_right" : "_left";
    j.hip[side] = {find("hip_flexion" + of, true), find("hip_adduction" + of, true), find("hip_rotation" + of, true)};
    j.knee[side] = find("knee_flexion" + of, true);
    j.ankle[side] = find("ankle_flexion" + of, true);
    j.shoulder[side] = {find("shoulder_flexion" + of, false), find("shoulder_abduction" + of, false),
                        find("shoulder_rotation" + of, false)};
    j.elbow[side] = find("elbow_flexion" + of, false);
    ball(j.hip[side]);
    ball(j.shoulder[side]);
  }
  j.lumbar = {find("lumbar_flexion", false), find("lumbar_bending", false), find("lumbar_rotation", false)};
  ball(j.lumbar);
  j.neck = find("neck_flexion", false);
  return j;
}

std::array<double, 3> threeAngles(const Mat3& R, const std::array<Vec3, 3>& e) {
  // With s = (e1 x e2) . e3 = 1 or -1:  R e3 = s sin q2 e1 + cos q2 (cos q1 e3 - s sin q1 e2),
  //                                     Rᵀ e1 = cos q2 (cos q3 e1 - s sin q3 e2) + s sin q2 e3.
  const double s = dot(cross(e[0], e[1]), e[2]) > 0 ? 1 : -1;
  const Vec3 c = R * e[2], r = transposeTimes(R, e[0]);
  const double q2 = std::asin(std::clamp(s * dot(c, e[0]), -1.0, 1.0));
  if (std::hypot(dot(c, e[1]), dot(c, e[2])) < 1e-9) {
    // q1 = 0: R e2 = R(e2, q2) R(e3, q3) e2, with R(e3, q3) e2 = cos q3 e2 - s sin q3 e1 and e2 unmoved by R(e2, q2).
    const Vec3 m = R * e[1], turned = rotationAbout(e[1], q2) * e[0];
    return {0, q2, std::atan2(-s * dot(m, turned), dot(m, e[1]))};
  }
  return {std::atan2(-s * dot(c, e[1]), dot(c, e[2])), q2, std::atan2(-s * dot(r, e[1]), dot(r, e[0]))};
}

void setDirections(const Skeleton& s, const LimbJoints& joints, const BodyDirections& body, std::vector<double>& q) {
  const Mat3& pelvis = body.pelvis;
  for (int side = 0; side < 2; ++side) {
    const Vec3 shank = boneOf(s, s.joints[joints.knee[side]].child);
    const Mat3 lower =
        setLimb(s, joints.hip[side], joints.knee[side], pelvis, body.leg[side], knee_hinge_weight, true, shank, q);
    if (body.foot[side]) {
      const int a = joints.ankle[side];
      q[a] = nearest(hingeAngle({1, 0, 0}, transposeTimes(lower, *body.foot[side]), s.joints[a].axis), q[a]);
    }
  }
  Mat3 torso = pelvis;
  if (joints.lumbar[0] >= 0 && joints.lumbar[1] >= 0 && joints.lumbar[2] >= 0 && body.torso) {
    torso = *body.torso;
    setBall(transpose(pelvis) * torso, axesOf(s, joints.lumbar), joints.lumbar, q);
  }
  if (joints.neck >= 0 && body.head) {
    const Vec3 up = transposeTimes(torso, body.head->c);
    q[joints.neck] = nearest(hingeAngle({0, 0, 1}, up, s.joints[joints.neck].axis), q[joints.neck]);
  }
  for (int side = 0; side < 2; ++side) {
    const auto& b = joints.shoulder[side];
    if (!body.arm[side] || b[0] < 0 || b[1] < 0 || b[2] < 0 || joints.elbow[side] < 0) continue;
    const Vec3 forearm = boneOf(s, s.joints[joints.elbow[side]].child);
    setLimb(s, b, joints.elbow[side], torso, *body.arm[side], elbow_hinge_weight, false, forearm, q);
  }
}

}  // namespace gambeson
