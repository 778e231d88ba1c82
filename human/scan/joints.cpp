#include "human/scan/joints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "human/scan/loops.hpp"

namespace gambeson {
namespace {

/// Where joints lie, in statures: of our six manikins, whose joint centres are those of ANSUR II and OpenSim, within
/// 0.01; sections give what lies across a limb. Rigs of characters place hips by other rules: MakeHuman's lie 0.015 of
/// a stature further out.
constexpr double kHipAboveCrotch = 0.0465, kHipLateral = 0.0495, kHipAheadOfCrotch = 0.002;
constexpr double kLumbarAboveCrotch = 0.102, kLumbarBehindCentre = 0.024;
constexpr double kNeckHeight = 0.855, kNeckBelowThinnest = 0.006, kNeckBehindCentre = 0.0095;
constexpr double kAnkleHeight = 0.0415, kAnkleOfFoot = 0.224;  ///< the latter: share of the foot's length from the heel
constexpr double kKneeOfLeg = 0.5;                             ///< from ankle to hip
constexpr double kShoulderLateral = 0.1015, kShoulderHeight = 0.799;
constexpr double kElbowOfArm = 0.485;  ///< from wrist to shoulder

struct Line {
  Vec3 through, along;
  Vec3 nearest(const Vec3& x) const { return through + dot(x - through, along) * along; }
};

/// The straight line through a limb's centres between two lengths along it: through their mean, from the mean of the
/// first half to that of the second.
Line lineThrough(const LimbLine& limb, double from, double to) {
  constexpr int n = 24;
  Vec3 first, second;
  for (int i = 0; i < n; ++i) {
    const Vec3 x = limb.at(from + (to - from) * (i + 0.5) / n);
    (i < n / 2 ? first : second) += x / (n / 2);
  }
  return {0.5 * (first + second), normalized(second - first)};
}

}  // namespace

std::map<std::string, Vec3> jointsOf(const TriangleMesh& body, const Landmarks& l) {
  const double H = l.stature_m;
  std::map<std::string, Vec3> at;
  for (int side = 0; side < 2; ++side) {
    const auto s = static_cast<std::size_t>(side);
    const std::string name = side == 0 ? "_right" : "_left";
    const double sign = side == 0 ? -1 : 1;

    const Vec3 hip = l.crotch + H * Vec3{kHipAheadOfCrotch, sign * kHipLateral, kHipAboveCrotch};
    const LimbLine& leg = l.leg[s];
    const auto level = [&](double z) { return leg.at(z - leg.centre.front().z); };
    // Along a leg lengths are nearly heights; one step mends the rest.
    const auto at_height = [&](double z) {
      Vec3 x = level(z);
      for (int i = 0; i < 3; ++i) x = level(z + (z - x.z));
      return x;
    };
    Vec3 ankle = at_height(kAnkleHeight * H);
    ankle.x = l.heel[s].x + kAnkleOfFoot * (l.toe_tip[s].x - l.heel[s].x);
    const Vec3 knee = at_height(ankle.z + kKneeOfLeg * (hip.z - ankle.z));
    at["thigh" + name] = hip, at["shank" + name] = knee, at["foot" + name] = ankle;
    at["toes" + name] = l.ball[s];

    const LimbLine& arm = l.arm[s];
    const double end = arm.along.back(), wrist = l.wrist[s];
    // The upper arm's line, from its middle part, on to where shoulders lie.
    const double middle = 0.5 * (wrist + end);
    Line upper = lineThrough(arm, middle + 0.15 * (end - middle), middle + 0.75 * (end - middle));
    const Vec3 expected{upper.through.x, l.crotch.y + sign * kShoulderLateral * H, kShoulderHeight * H};
    Vec3 shoulder = upper.nearest(expected);
    // What is left across the line is between the arm's and the joint's own place: half of it.
    const Vec3 across = expected - shoulder;
    shoulder += 0.5 * Vec3{0, across.y, across.z};
    const double reach = end + norm(shoulder - arm.centre.back());
    const double elbow_at = wrist + kElbowOfArm * (reach - wrist);
    // A bent arm's sections cut the corner; the lines of its two halves do not.
    upper = lineThrough(arm, elbow_at + 0.12 * (reach - elbow_at), std::min(end, elbow_at + 0.6 * (reach - elbow_at)));
    const Line fore = lineThrough(arm, wrist + 0.1 * (elbow_at - wrist), elbow_at - 0.15 * (elbow_at - wrist));
    const Vec3 path = arm.at(elbow_at);
    at["forearm" + name] = 0.5 * (upper.nearest(path) + fore.nearest(path));
    at["upper_arm" + name] = shoulder;
    at["hand" + name] = arm.at(wrist);
  }
  const double lumbar_z = l.crotch.z + kLumbarAboveCrotch * H;
  const std::vector<CutLoop> loops = cutLoops(body, CutPlane::level(lumbar_z));
  const CutLoop* trunk = nearestLoop(loops, {l.crotch.x, l.crotch.y});
  at["torso"] = {(trunk ? trunk->centre.x : l.crotch.x) - kLumbarBehindCentre * H, l.crotch.y, lumbar_z};
  at["head"] = {l.neck.centre.x - kNeckBehindCentre * H, l.crotch.y,
                0.5 * (kNeckHeight * H + l.neck_height_m - kNeckBelowThinnest * H)};
  at["pelvis"] = 0.5 * (at["thigh_right"] + at["thigh_left"]);
  return at;
}

}  // namespace gambeson
