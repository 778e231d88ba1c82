#include "human/scan/joints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "human/manikin/regressions.hpp"
#include "human/scan/loops.hpp"

namespace gambeson {
namespace {

/// Heights of joints are those that people of the body's stature and mass have in the mean of both sexes (ANSUR II, the
/// rules of human/data/manikins.json: hip at the trochanterion, knee at the lateral femoral epicondyle, ankle at the
/// lateral malleolus, shoulder below and inside the acromion), moved by what the body's own landmarks say. What follows
/// are the places across, and what skins show of those heights, in statures where no other unit is named.
constexpr double kShoulderBelowAcromion_m = 0.032, kShoulderInside_m = 0.024;
/// The crotch of a skin lies this far below the hip joints. A hip's height is moved by a part of what the crotch is
/// higher or lower than expected: both vary about their regressions by 25 mm, not wholly together.
constexpr double kHipAboveCrotch = 0.048, kHipByCrotch = 0.7;
/// Hip joints by Hara et al. 2016 (doi 10.1038/srep37707: tomography of 157 people, 120 of them grown up; said to be
/// off by 4 to 5 mm in each direction), of the leg's length L from anterior superior iliac spine to medial malleolus: 8
/// mm + 0.086 L from the median plane, 9 mm + 0.078 L below the spines. The paper's table was not read here; three
/// programs of others have these numbers, and for L = 0.88 m they give 84 and 78 mm, where the male of Rajagopal et al.
/// 2016 has 77 and 78 mm, Bell et al. 1989 (0.36 of 240 mm between the spines) 86 mm and Harrington et al. 2007 (0.28
/// of 150 mm of depth + 0.16 of that width + 8 mm) 88 mm. Rigs of characters have 69 mm (SMPL) to 110 mm (MakeHuman).
constexpr double kHaraLateral_m = 0.008, kHaraLateral = 0.086, kHaraBelow_m = 0.009, kHaraBelow = 0.078;
/// Hip, knee and ankle of most people lie on a line seen from ahead, so that knee and ankle show the hip too, within 2
/// degrees (16 mm). It has this part in a hip's place across, for bodies that are not built as people are.
constexpr double kHipByAxis = 0.33;
constexpr double kHipOfDepth = 0.53;  ///< of the trunk's depth there, from behind
/// A leg is thinnest 0.031 statures below its knee, if often over a length or twice: the mean of its levels, each with
/// the weight exp(-(girth / least - 1) / 0.01 - (how far from where it is expected / 0.02 statures)²). Half of the
/// knee's height is by this, half by the regressions.
constexpr double kThinBelowKnee = 0.031, kThinner = 0.01, kThinSpread = 0.02, kKneeByThinnest = 0.5;
constexpr double kLumbarAboveHip = 0.058, kLumbarBehindCentre = 0.0225;
constexpr double kShoulderBelowNeck = 0.066,
                 kShoulderByNeck = 0.3;  ///< below where it is thinnest; its part in the height
constexpr double kNeckBelowThinnest = 0.004, kNeckBehindCentre = 0.0095;
constexpr double kAnkleOfFoot = 0.224;    ///< share of the foot's length from the heel
constexpr double kShoulderAhead = 0.004;  ///< of the upper arm's line
constexpr double kElbowOfArm = 0.485;     ///< from wrist to shoulder

/// Lengths between joints that people have, in statures: 1st to 99th percentile of ANSUR II with a quarter more on
/// either side, for what is measured on skins, and for characters.
constexpr std::array<double, 2> kThigh{0.17, 0.31}, kShank{0.17, 0.31}, kUpperArm{0.125, 0.23}, kForearm{0.105, 0.20},
    kHand{0.065, 0.15};

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

/// The height where a leg is thinnest, near to where that is expected.
double thinnestOf(const LimbLine& leg, double expected, double stature_m) {
  const double spread = kThinSpread * stature_m;
  const auto near = [&](std::size_t i) { return std::abs(leg.centre[i].z - expected) < 4 * spread; };
  double least = std::numeric_limits<double>::infinity(), sum = 0, weights = 0;
  for (std::size_t i = 0; i < leg.size(); ++i)
    if (near(i)) least = std::min(least, leg.girth[i]);
  for (std::size_t i = 0; i < leg.size(); ++i) {
    if (!near(i)) continue;
    const double off = (leg.centre[i].z - expected) / spread;
    const double weight = std::exp(-(leg.girth[i] / least - 1) / kThinner - off * off);
    sum += weight * leg.centre[i].z, weights += weight;
  }
  return weights > 0 ? sum / weights : expected;
}

double volumeOf(const TriangleMesh& body) {
  double v = 0;
  for (const auto& t : body.triangles)
    v += dot(body.vertices[t[0]], cross(body.vertices[t[1]], body.vertices[t[2]])) / 6;
  return v;
}

}  // namespace

std::map<std::string, Vec3> jointsOf(const TriangleMesh& body, const Landmarks& l) {
  constexpr double kDensity_kg_per_m3 = 1000;
  const double H = l.stature_m, mass = kDensity_kg_per_m3 * volumeOf(body);
  const auto mean = [&](const char* name) { return meanMeasure(name, H, mass); };
  std::map<std::string, Vec3> at;
  const double ankle_z = mean("lateralmalleolusheight"), hip_mean = mean("trochanterionheight"),
               hip_z = hip_mean + kHipByCrotch * (l.crotch.z + kHipAboveCrotch * H - hip_mean),
               knee_of_leg = (mean("lateralfemoralepicondyleheight") - ankle_z) / (hip_mean - ankle_z);
  const double leg_length = (hip_z - ankle_z + kHaraBelow_m) / (1 - kHaraBelow);
  const auto trunkAt = [&](double z) {
    const std::vector<CutLoop> loops = cutLoops(body, CutPlane::level(z));
    const CutLoop* trunk = nearestLoop(loops, {l.crotch.x, l.crotch.y});
    return trunk ? *trunk : CutLoop{{{l.crotch.x, l.crotch.y}}, {l.crotch.x, l.crotch.y}};
  };
  const CutLoop hips = trunkAt(hip_z);
  const double hip_x = hips.low(0) + kHipOfDepth * (hips.high(0) - hips.low(0));
  const double by_acromion = mean("acromialheight") - kShoulderBelowAcromion_m,
               by_neck = l.neck_height_m - kShoulderBelowNeck * H,
               shoulder_z = by_acromion + kShoulderByNeck * (by_neck - by_acromion);
  for (int side = 0; side < 2; ++side) {
    const auto s = static_cast<std::size_t>(side);
    const std::string name = side == 0 ? "_right" : "_left";
    const double sign = side == 0 ? -1 : 1;

    const LimbLine& leg = l.leg[s];
    const auto level = [&](double z) { return leg.at(z - leg.centre.front().z); };
    // Along a leg lengths are nearly heights; one step mends the rest.
    const auto at_height = [&](double z) {
      Vec3 x = level(z);
      for (int i = 0; i < 3; ++i) x = level(z + (z - x.z));
      return x;
    };
    Vec3 ankle = at_height(ankle_z);
    ankle.x = l.heel[s].x + kAnkleOfFoot * (l.toe_tip[s].x - l.heel[s].x);
    const double knee_z = ankle.z + knee_of_leg * (hip_z - ankle.z), thin_z = knee_z - kThinBelowKnee * H;
    const Vec3 knee = at_height(knee_z + kKneeByThinnest * (thinnestOf(leg, thin_z, H) - thin_z));
    const double beside = kHaraLateral_m + kHaraLateral * leg_length,
                 on_axis = sign * (knee.y + (knee.y - ankle.y) / (knee.z - ankle.z) * (hip_z - knee.z) - l.crotch.y);
    const Vec3 hip{hip_x, l.crotch.y + sign * (beside + kHipByAxis * (on_axis - beside)), hip_z};
    at["thigh" + name] = hip, at["shank" + name] = knee, at["foot" + name] = ankle;
    at["toes" + name] = l.ball[s];

    const LimbLine& arm = l.arm[s];
    const double end = arm.along.back(), wrist = l.wrist[s];
    // The upper arm's line, from its middle part, on to where shoulders lie.
    const double middle = 0.5 * (wrist + end);
    Line upper = lineThrough(arm, middle + 0.15 * (end - middle), middle + 0.75 * (end - middle));
    const Vec3 expected{upper.through.x, l.crotch.y + sign * (0.5 * mean("biacromialbreadth") - kShoulderInside_m),
                        shoulder_z};
    Vec3 shoulder = upper.nearest(expected);
    // What is left across the line is between the arm's and the joint's own place: half of it.
    const Vec3 across = expected - shoulder;
    shoulder += Vec3{kShoulderAhead * H, 0.5 * across.y, 0.5 * across.z};
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
  const double lumbar_z = hip_z + kLumbarAboveHip * H;
  at["torso"] = {trunkAt(lumbar_z).centre.x - kLumbarBehindCentre * H, l.crotch.y, lumbar_z};
  at["head"] = {l.neck.centre.x - kNeckBehindCentre * H, l.crotch.y,
                0.5 * (mean("cervicaleheight") + l.neck_height_m - kNeckBelowThinnest * H)};
  at["pelvis"] = 0.5 * (at["thigh_right"] + at["thigh_left"]);
  return at;
}

void checkLengths(const std::map<std::string, Vec3>& at, const Landmarks& l, const std::string& file) {
  const double H = l.stature_m;
  const auto check = [&](const std::string& key, const std::string& what, double found, double least, double most) {
    if (!(found > least * H && found < most * H))
      throw InputError({file, 0, key},
                       fmt::format("the {} comes out {:.3f} m long, {:.3f} of the body's height; people's "
                                   "are {:.3f} to {:.3f} of it: is the limb whole, straight and finely "
                                   "enough meshed (edges of at most 2 cm)?",
                                   what, found, found / H, least, most));
  };
  for (const std::string side : {"right", "left"}) {
    const auto length = [&](const char* from, const char* to) {
      return norm(at.at(fmt::format("{}_{}", to, side)) - at.at(fmt::format("{}_{}", from, side)));
    };
    check("leg_" + side, side + " thigh", length("thigh", "shank"), kThigh[0], kThigh[1]);
    check("leg_" + side, side + " shank", length("shank", "foot"), kShank[0], kShank[1]);
    check("arm_" + side, side + " upper arm", length("upper_arm", "forearm"), kUpperArm[0], kUpperArm[1]);
    check("arm_" + side, side + " forearm", length("forearm", "hand"), kForearm[0], kForearm[1]);
    check("arm_" + side, side + " hand", norm(l.hand_tip[side == "left"] - at.at("hand_" + side)), kHand[0], kHand[1]);
  }
}

}  // namespace gambeson
