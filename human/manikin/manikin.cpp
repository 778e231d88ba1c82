#include "human/manikin/manikin.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "human/files/data.hpp"
#include "human/manikin/person.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::json;

/// Every number that human/data/manikins.json lacks, with its reason. Lengths are of the OpenSim model (stature 1.70 m)
/// where they say "scaled", and grow with stature.
namespace chosen {
/// Lateral semi-axis of the thigh over the hip's distance from the midline. The data's round thighs overlap by 30 to 60
/// mm; at 0.95 they clear each other at rest, the rest is done by the held abduction. The fore-aft axis keeps the
/// girth.
constexpr double thigh_lateral_over_hip_half = 0.95;
/// Level of the waist's and the chest's largest section: the data's own heights. Their vertical semi-axes are the
/// distance between them times this, so that waist and chest overlap without a groove (the data's waist, 0.1 m, leaves
/// one).
constexpr double waist_vertical_over_chest_distance = 0.75;
/// The data leave the pelvis bare above its ellipsoid. A second one at L5/S1, midway in size between hips and waist and
/// as high as the first, carries a waistband; it moves with the pelvis because the iliac crests do.
constexpr double iliac_share_of_hips = 0.5;
/// Fore-aft centre of pelvis, waist: over the pelvis's centre of mass, -0.0707 - (-0.0563) m scaled (OpenSim).
/// Fore-aft centre of the chest: halfway between that and the spine, since ribs surround the spine's front.
constexpr double chest_share_to_spine = 0.5;
/// The neck joint stands over L5/S1. The head's centre lies ahead of C7 [m, scaled]: the skull balances on the neck
/// with its centre of mass over the ear canal, some 30 mm ahead of C7.
constexpr double head_ahead_of_neck_m = 0.03;
/// Heel pad and skin behind OpenSim's heel point [m].
constexpr double heel_behind_heel_point_m = 0.015;
/// Neck: from C7 up into the head, half as high again as the distance to the head's lower end, so that both ends are
/// covered.
constexpr double neck_vertical_factor = 0.75;
/// The data leave a gap between chest and arm: a sphere as thick as the arm closes it at the shoulder joint, where it
/// reaches to within 30 mm of the bideltoid breadth. Neck limits: 45 degrees either way, the clinical normal range
/// (AAOS).
constexpr double neck_limit_deg = 45;
/// Knee limit [degrees]: the normal range of adults (137 to 142, Soucie et al. 2011, Haemophilia 17:500-507). Where the
/// OpenSim model stops (120), its muscle paths do.
constexpr double knee_limit_deg = 140;
/// The hand's centre of mass: the middle of its ellipsoid (de Leva's is referred to a length that the data lack).
/// The foot's centre of mass: likewise.
}  // namespace chosen

/// Semi-axis a of the ellipse with the other semi-axis b < r and the perimeter 2 pi r: 4 a E(sqrt(1 - b²/a²)) = 2 pi r.
double keepGirth(double b, double r) {
  double lo = r, hi = 2 * r;  // the perimeter at a = 2 r exceeds 4 a = 8 r > 2 pi r
  for (int i = 0; i < 100; ++i) {
    const double a = 0.5 * (lo + hi);
    (4 * a * std::comp_ellint_2(std::sqrt(1 - b * b / (a * a))) < 2 * std::numbers::pi * r ? lo : hi) = a;
  }
  return 0.5 * (lo + hi);
}

Vec3 vec(const Json& j) { return {j.at(0), j.at(1), j.at(2)}; }
/// [vertical, lateral, antero-posterior] of the data as semi-axes along x, y, z.
Ellipsoid upright(const Json& j) { return {{j.at(2), j.at(1), j.at(0)}}; }

struct Builder {
  Human human;
  const Json& limits_deg;

  int joint(int parent, const std::string& link, const std::string& name, const Vec3& origin, const Vec3& axis,
            double lower_deg, double upper_deg) {
    Joint j;
    j.name = name;
    j.type = JointType::revolute;
    j.parent = parent;
    j.child = static_cast<int>(human.skeleton.links.size());
    j.X_PJ.origin = origin;
    j.axis = axis;
    j.lower = lower_deg * rad_per_deg;
    j.upper = upper_deg * rad_per_deg;
    human.skeleton.links.push_back({link, static_cast<int>(human.skeleton.joints.size()), 0, {}});
    human.skeleton.joints.push_back(j);
    return j.child;
  }
  int joint(int parent, const std::string& link, const std::string& name, const Vec3& origin, const Vec3& axis,
            const char* limits) {
    return joint(parent, link, name, origin, axis, limits_deg.at(limits).at(0), limits_deg.at(limits).at(1));
  }
  int fixed(int parent, const std::string& link, const std::string& name, const Vec3& origin) {
    const int l = joint(parent, link, name, origin, {1, 0, 0}, 0.0, 0.0);
    human.skeleton.joints.back().type = JointType::fixed;
    return l;
  }
  void mass(int link, double mass_kg, const Vec3& com) {
    human.skeleton.links[link].mass_kg = mass_kg;
    human.skeleton.links[link].center_of_mass = com;
  }
  void shape(int link, const std::string& name, const Ellipsoid& e, const Vec3& centre) {
    human.shapes.push_back({link, name, e, {{}, centre}});
  }
};

/// A person's facts and the few lengths derived from them that several parts share.
struct Facts {
  const Json& person;
  const Json& leva;  ///< centres of mass in percent
  const Json& opensim;
  double scale = 1;  ///< stature over that of the OpenSim model

  double height(const char* name) const { return person.at("joint_centres_m").at(name); }
  double length(const char* name) const { return person.at("lengths_m").at(name); }
  double mass(const char* name) const { return person.at("segment_mass_kg").at(name); }
  double com(const char* name) const { return leva.at("com_percent_from_proximal").at(name).get<double>() / 100; }
  const Json& size(const char* name) const { return person.at("ellipsoid_semi_axes_m").at(name); }
  double hip() const { return height("hip_height"); }
  /// Forward of the hip joints [m].
  double forward(const char* in_pelvis) const {
    return scale * (opensim.at(in_pelvis).at(0).get<double>() - opensim.at("hip_in_pelvis").at(0).get<double>());
  }
};

void addLeg(Builder& b, const Facts& f, const std::string& side) {
  const double s = side == "left" ? 1 : -1;  // y
  const double thigh = f.length("thigh"), shank = f.length("shank"), half = f.height("hip_lateral_half");
  const Vec3 back{0, -1, 0}, mirrored_x{-s, 0, 0}, mirrored_z{0, 0, -s};
  const int f1 = b.joint(0, "thigh_" + side + "_f1", "hip_flexion_" + side, {0, s * half, 0}, back, "hip_flexion");
  const int f2 = b.joint(f1, "thigh_" + side + "_f2", "hip_adduction_" + side, {}, mirrored_x, "hip_adduction");
  const int t = b.joint(f2, "thigh_" + side, "hip_rotation_" + side, {}, mirrored_z, "hip_rotation");
  const Vec3 knee{f.scale * f.opensim.at("knee_in_femur").at(0).get<double>(), 0, -thigh};
  b.mass(t, f.mass("thigh"), f.com("thigh") * knee);
  const Json& semi = f.size("thigh");
  const double lateral = chosen::thigh_lateral_over_hip_half * half, round = semi.at(1);
  b.shape(t, "thigh_" + side, {{keepGirth(lateral, round), lateral, semi.at(0)}}, 0.5 * knee);
  const double r = f.size("thigh_distal_radius");
  b.shape(t, "knee_" + side, {{r, r, r}}, knee);

  const int k = b.joint(t, "shank_" + side, "knee_flexion_" + side, knee, {0, 1, 0}, 0, chosen::knee_limit_deg);
  const Vec3 ankle{f.scale * f.opensim.at("ankle_in_tibia").at(0).get<double>(), 0, -shank};
  b.mass(k, f.mass("shank"), f.com("shank") * ankle);
  b.shape(k, "shank_" + side, upright(f.size("shank")), 0.5 * ankle);

  const int foot = b.joint(k, "foot_" + side, "ankle_flexion_" + side, ankle, back, "ankle");
  const Vec3 semi_foot = vec(f.size("foot_length_breadth_height"));
  const double heel = f.scale * f.opensim.at("heel_in_talus").at(0).get<double>() - chosen::heel_behind_heel_point_m;
  const Vec3 centre{heel + semi_foot.x, 0, semi_foot.z - f.height("ankle_height")};
  b.mass(foot, f.mass("foot"), centre);
  b.shape(foot, "foot_" + side, {semi_foot}, centre);
}

void addArm(Builder& b, const Facts& f, int torso, const Vec3& shoulder, const std::string& side) {
  const double s = side == "left" ? 1 : -1;
  const Vec3 back{0, -1, 0}, mirrored_x{s, 0, 0}, mirrored_z{0, 0, -s};
  const int f1 =
      b.joint(torso, "upper_arm_" + side + "_f1", "shoulder_flexion_" + side, shoulder, back, "shoulder_flexion");
  const int f2 =
      b.joint(f1, "upper_arm_" + side + "_f2", "shoulder_abduction_" + side, {}, mirrored_x, "shoulder_abduction");
  const int u = b.joint(f2, "upper_arm_" + side, "shoulder_rotation_" + side, {}, mirrored_z, "shoulder_rotation");
  const Vec3 elbow{0, 0, -f.length("upper_arm")}, wrist{0, 0, -f.length("forearm")};
  b.mass(u, f.mass("upper_arm"), f.com("upper_arm") * elbow);
  b.shape(u, "upper_arm_" + side, upright(f.size("upper_arm")), 0.5 * elbow);
  const double r = f.size("upper_arm").at(1);
  b.shape(u, "shoulder_" + side, {{r, r, r}}, {});
  const int e = b.joint(u, "forearm_" + side, "elbow_flexion_" + side, elbow, back, "elbow_flexion");
  b.mass(e, f.mass("forearm"), f.com("forearm") * wrist);
  b.shape(e, "forearm_" + side, upright(f.size("forearm")), 0.5 * wrist);
  const int h = b.fixed(e, "hand_" + side, "wrist_" + side, wrist);
  const Vec3 semi = vec(f.size("hand"));  // the palm faces the thigh: the hand's breadth lies fore-aft
  b.mass(h, f.mass("hand"), {0, 0, -semi.x});
  b.shape(h, "hand_" + side, {{semi.y, semi.z, semi.x}}, {0, 0, -semi.x});
}

void addBody(Builder& b, const Facts& f) {
  const double middle = f.forward("pelvis_centre_of_mass"), spine = f.forward("back_in_pelvis");
  const double waist = f.person.at("heights_m").at("waist"), chest = f.person.at("heights_m").at("chest");
  const double lumbar = f.height("lumbar_L5S1_height"), neck = f.height("neck_C7_height");
  const Vec3 hips = upright(f.size("pelvis_hip_level")).semi_axes, waist_semi = upright(f.size("waist")).semi_axes;

  const double m = f.mass("trunk"), lower = f.leva.at("mass_percent").at("lower_trunk"),
               all = f.leva.at("mass_percent").at("trunk");
  const double m_pelvis = m * lower / all;
  const Vec3 c_pelvis{middle, 0, (1 - f.com("lower_trunk")) * (waist - f.hip())};
  const Vec3 c_trunk{0.5 * (middle + spine), 0, (1 - f.com("trunk")) * (neck - f.hip())};
  b.mass(0, m_pelvis, c_pelvis);
  b.shape(0, "pelvis", {hips}, {middle, 0, 0});
  Vec3 iliac = chosen::iliac_share_of_hips * hips + (1 - chosen::iliac_share_of_hips) * waist_semi;
  iliac.z = hips.z;
  b.shape(0, "iliac", {iliac}, {middle, 0, lumbar - f.hip()});

  const Vec3 joint_P{spine, 0, lumbar - f.hip()};
  const auto inTorso = [&](double x, double height) { return Vec3{x - spine, 0, height - lumbar}; };
  addLeg(b, f, "right");
  addLeg(b, f, "left");
  const int f1 = b.joint(0, "torso_f1", "lumbar_flexion", joint_P, {0, 1, 0}, "lumbar");
  const int f2 = b.joint(f1, "torso_f2", "lumbar_bending", {}, {1, 0, 0}, "lumbar");
  const int torso = b.joint(f2, "torso", "lumbar_rotation", {}, {0, 0, 1}, "lumbar");
  b.mass(torso, m - m_pelvis, (m * c_trunk - m_pelvis * c_pelvis) / (m - m_pelvis) - joint_P);
  const double reach = chosen::waist_vertical_over_chest_distance * (chest - waist);
  b.shape(torso, "waist", {{waist_semi.x, waist_semi.y, reach}}, inTorso(middle, waist));
  b.shape(torso, "chest", upright(f.size("chest")),
          inTorso(middle + chosen::chest_share_to_spine * (spine - middle), chest));

  const int head = b.joint(torso, "head", "neck_flexion", inTorso(spine, neck), {0, 1, 0}, -chosen::neck_limit_deg,
                           chosen::neck_limit_deg);
  const Vec3 skull = upright(f.size("head")).semi_axes;
  const double top = f.person.at("stature_m").get<double>() - neck, ahead = f.scale * chosen::head_ahead_of_neck_m;
  const double r = f.size("neck_radius"), chin = top - 2 * skull.z;
  b.shape(head, "neck", {{r, r, r + chosen::neck_vertical_factor * chin}}, {0.5 * ahead, 0, 0.5 * chin});
  b.shape(head, "head", {skull}, {ahead, 0, top - skull.z});
  b.mass(head, f.mass("head"), {ahead, 0, (1 - f.com("head")) * top});

  const Vec3 shoulder =
      inTorso(spine + f.scale * f.opensim.at("shoulder_in_torso").at(0).get<double>(), f.height("shoulder_height"));
  const double half = f.height("shoulder_lateral_half");
  addArm(b, f, torso, {shoulder.x, -half, shoulder.z}, "right");
  addArm(b, f, torso, {shoulder.x, half, shoulder.z}, "left");
}

}  // namespace

const std::vector<std::string>& manikinNames() {
  static const std::vector<std::string> names{"male_p5",   "male_p50",   "male_p95",
                                              "female_p5", "female_p50", "female_p95"};
  return names;
}

Human manikinOf(const nlohmann::json& person, bool female, const std::string& name) {
  const Json facts = Json::parse(data::manikins);
  const Json& opensim = facts.at("opensim_offsets_m");
  const double stature = person.at("stature_m");
  Builder b{{}, facts.at("joint_range_limits_deg")};
  b.human.mass_kg = person.at("mass_kg");
  b.human.stature_m = stature;
  b.human.skeleton.name = name;
  b.human.skeleton.links.push_back({"pelvis", -1, 0, {}});
  addBody(b, {person, facts.at("de_leva_1996").at(female ? "female" : "male"), opensim,
              stature / opensim.at("stature").get<double>()});
  return b.human;
}

Human makeManikin(const std::string& name) {
  const Json facts = Json::parse(data::manikins);
  if (!facts.at("manikins").contains(name)) {
    std::string all;
    for (const std::string& n : manikinNames()) all += (all.empty() ? "" : ", ") + n;
    throw InputError({"", 0, "manikin"}, "there is no manikin '" + name + "'; there are " + all);
  }
  return manikinOf(facts.at("manikins").at(name), name.starts_with("female"), name);
}

}  // namespace gambeson
