#include "human/manikin/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "human/body/section.hpp"
#include "human/manikin/manikin.hpp"
#include "human/manikin/odd_measures.hpp"
#include "human/manikin/person.hpp"
#include "human/manikin/regressions.hpp"

namespace gambeson {
namespace {

using Json = nlohmann::json;

constexpr double kLeastIndex = 14, kMostIndex = 50;    ///< body-mass index [kg/m²]
constexpr double kGirthErrors = 6, kInseamErrors = 4;  ///< standard errors of the regressions that a measure may be off
constexpr double kMadeWithin = 0.01;                   ///< of a girth: beyond that a note tells
/// Of a segment's length is the long semi-axis of its ellipsoid; of the flexed girths those of hanging arms. Both as in
/// manikins.json, whose six people they give to 0.1 mm.
constexpr double kHalfOfLength = 0.55, kUpperArmOfFlexed = 0.94, kForearmOfFlexed = 0.95;
/// Head: half its height grows by 15.5 mm per metre of stature; half the thickness of a hand is 14 mm (manikins.json).
constexpr double kHeadPerStature = 0.0155, kHeadMale_m = 0.0912, kHeadFemale_m = 0.0896, kHandHalf_m = 0.014;
/// Joint-centre rules of manikins.json.
constexpr double kShoulderBelowAcromion_m = 0.04, kShoulderInside_m = 0.03, kHipOfStature = 0.045,
                 kLumbarOfStature = 0.105 / 1.755;
/// Shares of mass (de Leva 1996), in percent of the body's.
constexpr std::array<const char*, 8> kSegments{"head", "trunk", "upper_arm", "forearm",
                                               "hand", "thigh", "shank",     "foot"};
constexpr std::array<double, 8> kMale{6.94, 43.46, 2.71, 1.62, 0.61, 14.16, 4.33, 1.37};
constexpr std::array<double, 8> kFemale{6.68, 42.57, 2.55, 1.38, 0.56, 14.78, 4.81, 1.29};

/// The facts of a person, with the keys of manikins.json.
Json personOf(const ManikinMeasures& a, const Regressions& r) {
  const double ankle = r.m("lateralmalleolusheight"), crotch = r.m("crotchheight"), neck = r.m("cervicaleheight");
  const double inseam = a.inseam_m.value_or(crotch);
  const auto moved = [&](double height) {
    if (height <= crotch) return ankle + (height - ankle) * (inseam - ankle) / (crotch - ankle);
    return neck - (neck - height) * (neck - inseam) / (neck - crotch);
  };
  const double knee = moved(r.m("lateralfemoralepicondyleheight")), hip_by_data = r.m("trochanterionheight"),
               hip = moved(hip_by_data);
  const double shoulder = r.m("acromialheight") - kShoulderBelowAcromion_m;
  const double upper_arm = r.m("acromionradialelength") - kShoulderBelowAcromion_m,
               forearm = r.m("radialestylionlength");
  const double thigh = hip - knee, shank = knee - ankle;
  const double chest_half =
      0.5 * (moved(r.m("suprasternaleheight")) - moved(r.m("tenthribheight"))) * 2 * kHalfOfLength;
  Json p;
  p["stature_m"] = a.stature_m;
  p["mass_kg"] = a.mass_kg;
  p["joint_centres_m"] = {{"ankle_height", ankle},
                          {"knee_height", knee},
                          {"hip_height", hip},
                          {"hip_lateral_half", kHipOfStature * a.stature_m},
                          {"lumbar_L5S1_height", moved(hip_by_data + kLumbarOfStature * a.stature_m)},
                          {"neck_C7_height", neck},
                          {"shoulder_height", shoulder},
                          {"shoulder_lateral_half", 0.5 * r.m("biacromialbreadth") - kShoulderInside_m},
                          {"elbow_height", shoulder - upper_arm},
                          {"wrist_height", shoulder - upper_arm - forearm}};
  p["lengths_m"] = {{"thigh", thigh},
                    {"shank", shank},
                    {"foot", r.m("footlength")},
                    {"upper_arm", upper_arm},
                    {"forearm", forearm},
                    {"hand", r.m("handlength")},
                    {"head_neck", a.stature_m - neck}};
  const double thigh_radius = r.radius("thighcircumference"), calf = r.radius("calfcircumference"),
               arm = kUpperArmOfFlexed * r.radius("bicepscircumferenceflexed"),
               fore = kForearmOfFlexed * r.radius("forearmcircumferenceflexed");
  p["ellipsoid_semi_axes_m"] = {
      {"thigh", {kHalfOfLength * thigh, thigh_radius, thigh_radius}},
      {"thigh_distal_radius", r.radius("lowerthighcircumference")},
      {"shank", {kHalfOfLength * shank, calf, calf}},
      {"ankle_radius", r.radius("anklecircumference")},
      {"foot_length_breadth_height", {0.5 * r.m("footlength"), 0.5 * r.m("footbreadthhorizontal"), 0.5 * ankle}},
      {"upper_arm", {kHalfOfLength * upper_arm, arm, arm}},
      {"forearm", {kHalfOfLength * forearm, fore, fore}},
      {"wrist_radius", r.radius("wristcircumference")},
      {"hand", {0.5 * r.m("handlength"), 0.5 * r.m("handbreadth"), kHandHalf_m}},
      {"pelvis_hip_level",
       {0.5 * (moved(r.m("iliocristaleheight")) - inseam), 0.5 * r.m("hipbreadth"), 0.5 * r.m("buttockdepth")}},
      {"waist", {0.1, 0.5 * r.m("waistbreadth"), 0.5 * r.m("waistdepth")}},
      {"chest", {chest_half, 0.5 * r.m("chestbreadth"), 0.5 * r.m("chestdepth")}},
      {"shoulder_half_breadth_bideltoid", 0.5 * r.m("bideltoidbreadth")},
      {"head",
       {kHeadPerStature * a.stature_m + (a.sex == Sex::male ? kHeadMale_m : kHeadFemale_m), 0.5 * r.m("headbreadth"),
        0.5 * r.m("headlength")}},
      {"neck_radius", r.radius("neckcircumference")}};
  p["heights_m"] = {
      {"waist", moved(r.m("waistheightomphalion"))}, {"chest", moved(r.m("chestheight"))}, {"crotch", inseam}};
  p["thigh_girth_m"] = r.m("thighcircumference");
  for (std::size_t k = 0; k < kSegments.size(); ++k)
    p["segment_mass_kg"][kSegments[k]] = (a.sex == Sex::male ? kMale : kFemale)[k] / 100 * a.mass_kg;
  return p;
}

/// One girth: where it is taken, and the ellipsoid of the facts that makes it.
struct Girth {
  const char *name, *ellipsoid;
  std::optional<double> asked_m;
  double height_m;
  std::vector<std::string> links;
  double most_lateral_m;  ///< of the ellipsoid's lateral semi-axis
};

/// Grows (or shrinks) the ellipsoid by a factor; what its lateral semi-axis may not take the other one does.
void grow(Json& semi, double factor, double most_lateral) {
  const double lateral = semi.at(1), depth = semi.at(2);
  const double wide = std::min(factor * lateral, std::max(lateral, most_lateral));
  semi.at(1) = wide;
  semi.at(2) = depth * factor * (factor > 1 && wide < factor * lateral ? factor * lateral / wide : 1);
}

}  // namespace

double girthAt(const Human& human, double height_m, const std::vector<std::string>& links) {
  std::vector<double> q(human.skeleton.joints.size(), 0.0);
  for (const char* side : {"_right", "_left"})
    if (const int hip = human.skeleton.joint(std::string("hip_adduction") + side); hip >= 0)
      q[static_cast<std::size_t>(hip)] = -held_hip_abduction_rad;
  const std::vector<Pose> X = linkPoses(human.skeleton, q, {});
  const std::vector<Placement> at = placementsOf(human, X);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < human.shapes.size(); ++i) {
    const std::string& link = human.skeleton.links[static_cast<std::size_t>(human.shapes[i].link)].name;
    if (std::find(links.begin(), links.end(), link) == links.end()) continue;
    for (const Vec2& p : crossSection(human.shapes[i].shape, at[i], height_m)) points.push_back(p);
  }
  return tapeGirth(std::move(points));
}

std::vector<OddMeasure> oddMeasures(const ManikinMeasures& a) {
  const double square = a.stature_m * a.stature_m;
  if (!(a.mass_kg >= kLeastIndex * square && a.mass_kg <= kMostIndex * square))
    return {{"mass", a.mass_kg, kLeastIndex * square, kMostIndex * square}};
  const Regressions r = regressionsFor(a.sex, a.stature_m, a.mass_kg);
  std::vector<OddMeasure> odd;
  const auto check = [&](const char* key, const std::optional<double>& asked, const char* name, double errors) {
    const double expected = r.m(name), off = errors * r.error_m(name);
    if (asked && !(std::abs(*asked - expected) <= off)) odd.push_back({key, *asked, expected - off, expected + off});
  };
  check("inseam", a.inseam_m, "crotchheight", kInseamErrors);
  check("chest", a.chest_m, "chestcircumference", kGirthErrors);
  check("waist", a.waist_m, "waistcircumference", kGirthErrors);
  check("hip", a.hip_m, "buttockcircumference", kGirthErrors);
  return odd;
}

Human makeManikin(const ManikinMeasures& a, MeasuresReport* report) {
  const bool female = a.sex == Sex::female;
  if (const std::vector<OddMeasure> odd = oddMeasures(a); !odd.empty()) {
    const OddMeasure& o = odd.front();
    const bool mass = o.key == "mass";
    throw InputError({"", 0, o.key},
                     fmt::format("{:.4g} {} goes with no body of {:.4g} m{}; allowed: {:.4g} to {:.4g} {}", o.value,
                                 mass ? "kg" : "m", a.stature_m, mass ? "" : fmt::format(" and {:.4g} kg", a.mass_kg),
                                 o.least, o.most, mass ? "kg" : "m"));
  }
  const Regressions r = regressionsFor(a.sex, a.stature_m, a.mass_kg);

  Json person = personOf(a, r);
  const Json &heights = person.at("heights_m"), &joints = person.at("joint_centres_m");
  const double hip = joints.at("hip_height");
  // The inner side of an arm that hangs as it is held, at the height of the chest.
  const double drop = joints.at("shoulder_height").get<double>() - heights.at("chest").get<double>();
  const double arms = joints.at("shoulder_lateral_half").get<double>() + drop * std::tan(held_shoulder_abduction_rad) -
                      person.at("ellipsoid_semi_axes_m").at("upper_arm").at(1).get<double>();
  const std::vector<std::string> trunk{"pelvis", "torso"};
  const std::array<Girth, 3> girths{
      Girth{"hip", "pelvis_hip_level", a.hip_m, 0, {"pelvis", "thigh_left", "thigh_right"}, 1},
      Girth{"waist", "waist", a.waist_m, heights.at("waist").get<double>() - hip, trunk, 1},
      Girth{"chest", "chest", a.chest_m, heights.at("chest").get<double>() - hip, trunk, arms}};
  const std::string name =
      fmt::format("{}_{:.0f}cm_{:.0f}kg", female ? "female" : "male", 100 * a.stature_m, a.mass_kg);
  Human made = manikinOf(person, female, name);
  // The iliac ellipsoid lies between hips and waist, so each girth moves its neighbour a little.
  for (int round = 0; round < 60; ++round)
    for (const Girth& g : girths) {
      if (!g.asked_m) continue;
      grow(person.at("ellipsoid_semi_axes_m").at(g.ellipsoid), *g.asked_m / girthAt(made, g.height_m, g.links),
           g.most_lateral_m);
      made = manikinOf(person, female, name);
    }

  MeasuresReport mine;
  MeasuresReport& said = report ? *report : mine;
  for (const Girth& g : girths) {
    if (!g.asked_m) continue;
    said.girths.push_back({g.name, *g.asked_m, girthAt(made, g.height_m, g.links)});
    const MadeGirth& m = said.girths.back();
    if (!(std::abs(m.made_m / m.asked_m - 1) <= kMadeWithin))
      said.notes.push_back(
          fmt::format("the {} of the body is {:.1f} cm, not the {:.1f} cm asked for: the rest of the "
                      "trunk reaches that far",
                      m.name, 100 * m.made_m, 100 * m.asked_m));
  }
  const auto beyond = [&](const char* key, double value, const char* what, const char* unit) {
    const double low = r.of.at(key).at(0), high = r.of.at(key).at(1);
    if (value < low || value > high)
      said.notes.push_back(
          fmt::format("{} {:.4g} {} is beyond the people measured ({:.4g} to {:.4g} {}): the "
                      "regressions are extrapolated",
                      what, value, unit, low, high, unit));
  };
  beyond("stature_m", a.stature_m, "stature", "m");
  beyond("mass_kg", a.mass_kg, "mass", "kg");
  return made;
}

}  // namespace gambeson
