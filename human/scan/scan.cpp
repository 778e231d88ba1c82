#include "human/scan/scan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "human/body/girths.hpp"
#include "human/body/section.hpp"
#include "human/body/skin.hpp"
#include "human/character/character.hpp"
#include "human/files/mesh.hpp"
#include "human/files/units.hpp"
#include "human/manikin/manikin.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"
#include "human/scan/joints.hpp"
#include "human/scan/landmarks.hpp"
#include "human/scan/repair.hpp"
#include "human/scan/tailor.hpp"
#include "human/scan/upright.hpp"
#include "human/scan/weights.hpp"
#include "human/skeleton/joint_map.hpp"
#include "human/skin/overlap.hpp"

namespace gambeson {
namespace {

RiggedMesh rigged(TriangleMesh body, const std::string& file, const Landmarks& marks) {
  RiggedMesh out;
  out.file = file;
  const std::map<std::string, Vec3> joints = jointsOf(body, marks);
  checkLengths(joints, marks, file);
  for (const std::string& link : scanLinks()) out.bones.push_back({link, -1, joints.at(link)});
  for (const char* side : {"_left", "_right"})
    out.bones.push_back({std::string("toes") + side, -1, joints.at(std::string("toes") + side)});
  out.first = {0};
  SkinWeights skin = weightsOf(body, marks, joints);
  for (const VertexWeights& list : skin.weights) {
    for (const auto& [link, w] : list) out.bone.push_back(link), out.weight.push_back(w);
    out.first.push_back(static_cast<int>(out.bone.size()));
  }
  out.part = std::move(skin.part);
  out.mesh = std::move(body);
  return out;
}

/// Girths in a posture, where both postures have the same part of the surface.
std::vector<std::pair<std::string, double>> girthsOf(const Human& human, const std::vector<Pose>& links) {
  std::vector<Vec3> x(human.skin->rest.vertices.size());
  skinPositions(*human.skin, links, x);
  std::vector<std::pair<std::string, double>> girths;
  for (const GirthPlane& plane : girthPlanes(human, links))
    girths.emplace_back(plane.zone, tapeGirth(bodySection(human, plane, links, x)));
  return girths;
}

/// What arms that come down may fold of the skin [m²]: beyond that cloth in the armpits has no room.
constexpr double kFold_m2 = 2e-4;
/// Farther aside no arms are held, as of a body that was scanned in a T-pose.
constexpr double kMostAside_rad = 45 * rad_per_deg;

/// Limits the arms to where the trunk lets them: the least abduction, from the usual one of standing up to the scan's
/// own, to half a degree, at which the standing skin passes through itself by at most kFold_m2 more than with the arms
/// as they were scanned. Lower ones would lie in the trunk, and crush the cloth between them.
void holdArmsOffTheTrunk(Human& human, std::vector<std::string>& notes) {
  std::array<Joint*, 2> shoulders{};
  const Posture bind = postureOfSkin(human);
  double aside = 0;
  for (std::size_t s = 0; s < 2; ++s) {
    const int j = human.skeleton.joint(s == 0 ? "shoulder_abduction_right" : "shoulder_abduction_left");
    shoulders[s] = &human.skeleton.joints[static_cast<std::size_t>(j)];
    aside = std::max(aside, std::min(bind.q[static_cast<std::size_t>(j)], kMostAside_rad));
  }
  const double usual = shoulders[0]->lower;
  const auto limit = [&](double abduction) {
    for (Joint* j : shoulders) j->lower = abduction;
  };
  std::vector<Vec3> x(human.skin->rest.vertices.size());
  const auto foldedAt = [&](double abduction) {
    limit(abduction);
    const Posture p = standing(human);
    skinPositions(*human.skin, linkPoses(human.skeleton, p.q, p.root), x);
    return overlapOf(human.skin->rest.triangles, x).area_m2;
  };
  const double most = foldedAt(aside) + kFold_m2;
  double lies = held_shoulder_abduction_rad, free = aside;
  if (!(aside > lies) || foldedAt(lies) <= most) return limit(usual);
  while (free - lies > 0.5 * rad_per_deg) {
    const double middle = 0.5 * (lies + free);
    (foldedAt(middle) <= most ? free : lies) = middle;
  }
  limit(free);
  notes.push_back(
      fmt::format("its arms are held {:.0f} degrees aside: lower, they would lie in the trunk", free / rad_per_deg));
}

}  // namespace

Human scanOf(const TriangleMesh& raw, const ScanOptions& o, ScanReport* report) {
  ScanReport mine;
  ScanReport& said = report ? *report : mine;
  const std::string file = o.file.string();
  RepairReport repair;
  TriangleMesh body = repaired(raw, o.close_holes, file, repair);
  said.notes = repair.notes;
  Stance given{o.height_m, {}, {}};
  if (!o.up.empty()) given.up = namedAxis(o.up);
  if (!o.facing.empty()) given.facing = namedAxis(o.facing);
  body = upright(std::move(body), given, file, said.notes);
  Landmarks marks;
  try {
    marks = landmarksOf(body, file);
  } catch (const InputError& e) {
    if (const int handles = handlesOf(body); handles > 0)
      throw InputError(e.where(), e.reason() + fmt::format(" (its surface closes {} loop{}: a limb touches the body, "
                                                           "such as a hand at the hip)",
                                                           handles, handles == 1 ? "" : "s"));
    throw;
  }
  if (const int handles = handlesOf(body); handles > 0)
    said.notes.push_back(
        fmt::format("its surface closes {} loop{}: somewhere it touches itself", handles, handles == 1 ? "" : "s"));
  CharacterOptions options;
  options.like = o.like, options.mass_kg = o.mass_kg;
  CharacterReport found;
  Human human = characterOf(rigged(std::move(body), file, marks), options, &found);
  said.pose = found.pose, said.arms_deg = found.arms_deg, said.height_m = found.height_m;
  said.volume_m3 = found.volume_m3;
  holdArmsOffTheTrunk(human, said.notes);
  const Posture posture = standing(human);
  const std::vector<Pose> links = linkPoses(human.skeleton, posture.q, posture.root);
  const auto scanned = girthsOf(human, human.skin->bind), stands = girthsOf(human, links);
  for (std::size_t k = 0; k < scanned.size(); ++k)
    said.girths.push_back({scanned[k].first, scanned[k].second, stands[k].second});
  for (ScanGirth& g : tailorsGirths(human, marks.crotch.z, links)) said.girths.push_back(std::move(g));
  return human;
}

Human loadScan(const ScanOptions& o, ScanReport* report) {
  constexpr double kUnknownUnit =
      1e-3;  // a body in millimetres goes beyond the coordinates that a mesh in metres may have
  TriangleMesh mesh = loadTriangles(o.file, kUnknownUnit);
  for (Vec3& x : mesh.vertices) x *= 1 / kUnknownUnit;
  return scanOf(mesh, o, report);
}

}  // namespace gambeson
