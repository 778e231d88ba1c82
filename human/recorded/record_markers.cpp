/// Detail of captured_motion.hpp: Markers as a captured motion. Man 2006, section 5.1: a segment is known from its
/// joint centres J1, J2 and a marker M,
///   e1 = (J2 - J1) / |J2 - J1|,  e2 = M - x_c less its part along e1, made unit,  e3 = e1 x e2,  x_c = (J1 + J2) / 2.
/// Where the file has no joint centres, they come from a scaled OpenSim model, whose bodies are laid on their markers
/// by least squares, hanging together at the joints; the body's own lateral axis then takes the place of M.

#include <fmt/format.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cmath>

#include "core/error.hpp"
#include "human/motion/motion.hpp"
#include "human/recorded/captured_motion.hpp"

namespace gambeson {
namespace {

/// Weight of a joint centre among markers in a fit, squared ratio of a marker's sliding on the skin (10 mm) to the play
/// of a joint (5 mm).
constexpr double joint_weight = 4;
constexpr int rounds = 20;
/// A marker further from its place than this means that the model is another's.
constexpr double largest_misfit_m = 0.12;

struct Pair {
  Vec3 body, seen;
  double weight;
};

Eigen::Vector3d eigen(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 vec(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// The rigid motion that lays points of a body on those seen with the least weighted squares (Kabsch 1976).
Pose laidOn(const std::vector<Pair>& pairs) {
  double w = 0;
  Vec3 b, s;
  for (const Pair& p : pairs) w += p.weight, b += p.weight * p.body, s += p.weight * p.seen;
  b = b / w, s = s / w;
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  for (const Pair& p : pairs) H += p.weight * eigen(p.body - b) * eigen(p.seen - s).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d V = svd.matrixV();
  if ((V * svd.matrixU().transpose()).determinant() < 0) V.col(2) *= -1;
  const Eigen::Matrix3d R = V * svd.matrixU().transpose();
  const Mat3 rotation{vec(R.col(0)), vec(R.col(1)), vec(R.col(2))};
  return {rotation, s - rotation * b};
}

Vec3 across(const Vec3& v, const Vec3& unit) { return v - dot(v, unit) * unit; }

/// What all frames share.
struct Source {
  const MarkerTable& table;
  const JointMap& map;
  std::size_t frame = 0;

  [[noreturn]] void fail(const std::string& name, const std::string& reason) const {
    throw InputError({table.file, 0, name}, fmt::format("{} at {} s", reason, table.times[frame]));
  }
  bool seen(const std::string& name) const {
    const int m = table.marker(name);
    return m >= 0 && std::isfinite(table.positions[frame][m].x);
  }
  Vec3 point(const Points& names) const {
    Vec3 sum;
    for (const std::string& n : names) {
      if (table.marker(n) < 0)
        throw InputError({table.file, 0, n}, "is missing in the file; the map '" + map.name + "' asks for it");
      if (!seen(n)) fail(n, "was not seen");
      sum += table.positions[frame][table.marker(n)];
    }
    return sum / static_cast<double>(names.size());
  }
  bool has(const std::array<Points, 2>& ends) const {
    for (const Points& p : ends)
      for (const std::string& n : p)
        if (table.marker(n) < 0) return false;
    return true;
  }
  /// Lays a body on its markers that are seen and on what else is known of it.
  Pose lay(const OsimModel& model, const std::string& body, std::vector<Pair> pairs = {}) const {
    for (const auto& [name, at] : model.body(body).markers)
      if (seen(name)) pairs.push_back({at, table.positions[frame][table.marker(name)], 1});
    if (pairs.size() < 3) fail(body, "fewer than three markers of the model's body were seen");
    const Pose X = laidOn(pairs);
    for (const Pair& p : pairs)
      if (!(norm(X * p.body - p.seen) < largest_misfit_m))
        fail(body, fmt::format("a marker lies {:.0f} mm from its place on the body: is the model that of this subject?",
                               1e3 * norm(X * p.body - p.seen)));
    return X;
  }
};

/// Arms from markers, the same for both kinds of map.
void addArms(const Source& s, const Mat3& to_ours, BodyDirections& b) {
  for (int side = 0; side < 2; ++side) {
    const auto upper = s.map.bones.find(sided("upper_arm", side)), lower = s.map.bones.find(sided("forearm", side));
    if (upper == s.map.bones.end() || lower == s.map.bones.end() || !s.has(upper->second) || !s.has(lower->second))
      continue;
    const Vec3 u = normalized(to_ours * (s.point(upper->second[1]) - s.point(upper->second[0])));
    const Vec3 l = normalized(to_ours * (s.point(lower->second[1]) - s.point(lower->second[0])));
    const Mat3 torso = b.torso.value_or(b.pelvis);
    b.arm[side] = LimbDirections{u, l, -(shortestTurn(-torso.c, u) * torso).b};
  }
}

/// A leg's bodies on their markers, hanging together at the joints.
struct Leg {
  std::string femur, tibia, calcn;
  Vec3 hip_P, knee_T, ankle_S, ankle_F;  ///< joint centres in pelvis, thigh, shank and foot
  Pose thigh, shank, foot;
};

/// Joint centres from the model. Each body in turn is laid on its markers and on the joint centres that its neighbours
/// show, until they agree: block by block, the least squares of all markers with joints as stiff springs.
BodyDirections fromModel(const Source& s, const OsimModel& model, const Mat3& to_ours) {
  const Mat3 body = axesOf({1, 0, 0}, {0, 1, 0});  // frames of OpenSim's bodies
  const auto ours = [&](const Pose& X) { return to_ours * X.rotation * transpose(body); };
  const auto name = [&](const char* segment, int side) { return s.map.bodies.at(sided(segment, side)); };
  const std::string pelvis_body = s.map.bodies.at("pelvis");
  Pose pelvis = s.lay(model, pelvis_body);
  std::array<Leg, 2> legs;
  for (int side = 0; side < 2; ++side) {
    Leg& l = legs[side];
    l.femur = name("thigh", side), l.tibia = name("shank", side), l.calcn = name("foot", side);
    l.hip_P = model.body(l.femur).originAt(0), l.knee_T = model.body(l.tibia).originAt(0);
    l.ankle_S = model.body(name("ankle", side)).originAt(0), l.ankle_F = -model.body(l.calcn).originAt(0);
    l.foot = s.lay(model, l.calcn);
    l.thigh = s.lay(model, l.femur, {{{}, pelvis * l.hip_P, joint_weight}});
    l.shank = s.lay(model, l.tibia, {{l.ankle_S, l.foot * l.ankle_F, joint_weight}});
  }
  for (int round = 0; round < rounds; ++round) {
    std::vector<Pair> hips;
    for (Leg& l : legs) {
      l.thigh = s.lay(model, l.femur, {{{}, pelvis * l.hip_P, joint_weight}, {l.knee_T, l.shank.origin, joint_weight}});
      l.shank = s.lay(model, l.tibia,
                      {{{}, l.thigh * l.knee_T, joint_weight}, {l.ankle_S, l.foot * l.ankle_F, joint_weight}});
      l.foot = s.lay(model, l.calcn, {{l.ankle_F, l.shank * l.ankle_S, joint_weight}});
      // The knee's centre moves along with its bend, which is about the thigh's z.
      const Mat3 R = transpose(l.thigh.rotation) * l.shank.rotation;
      l.knee_T = model.body(l.tibia).originAt(std::atan2(R.a.y, R.a.x));
      hips.push_back({l.hip_P, l.thigh.origin, joint_weight});
    }
    pelvis = s.lay(model, pelvis_body, hips);
  }
  BodyDirections b;
  b.pelvis = ours(pelvis);
  if (s.map.bodies.contains("torso")) b.torso = ours(s.lay(model, s.map.bodies.at("torso")));
  for (int side = 0; side < 2; ++side) {
    const Leg& l = legs[side];
    const Vec3 hip = 0.5 * (pelvis * l.hip_P + l.thigh.origin), knee = 0.5 * (l.thigh * l.knee_T + l.shank.origin),
               ankle = 0.5 * (l.shank * l.ankle_S + l.foot * l.ankle_F);
    b.hips += 0.5 * (to_ours * hip);
    b.leg[side] = {normalized(to_ours * (knee - hip)), normalized(to_ours * (ankle - knee)), ours(l.thigh).b};
    b.foot[side] = ours(l.foot).a;
  }
  addArms(s, to_ours, b);
  return b;
}

/// Man's construction: the direction in our axes that a marker beside a bone shows, as the left of the segment.
Vec3 leftFrom(const std::string& side, const Vec3& bone, const Vec3& marker) {
  const Vec3 e2 = normalized(across(marker, bone));
  if (side == "left") return e2;
  if (side == "right") return -e2;
  const Vec3 forward = side == "front" ? e2 : -e2;
  return cross(-bone, forward);  // up x forward, the bone hanging down
}

BodyDirections fromPoints(const Source& s, const Mat3& to_ours) {
  BodyDirections b;
  const Vec3 right = to_ours * s.point(s.map.hips[0]), left = to_ours * s.point(s.map.hips[1]);
  b.hips = 0.5 * (right + left);
  const Vec3 y = normalized(left - right);
  const Vec3 m = normalized(across(to_ours * s.point(s.map.pelvis_marker) - b.hips, y));
  const Vec3 x = s.map.pelvis_side == "above" ? cross(y, m) : s.map.pelvis_side == "front" ? m : -m;
  b.pelvis = {x, y, cross(x, y)};
  const auto bone = [&](const std::string& segment) {
    const auto& ends = s.map.bones.at(segment);
    return to_ours * (s.point(ends[1]) - s.point(ends[0]));
  };
  if (!s.map.torso_bone[0].empty()) {
    const Vec3 up = normalized(to_ours * (s.point(s.map.torso_bone[1]) - s.point(s.map.torso_bone[0])));
    const Vec3 l = normalized(across(b.pelvis.b, up));
    b.torso = Mat3{cross(l, up), l, up};
  }
  for (int side = 0; side < 2; ++side) {
    const std::string thigh = sided("thigh", side);
    const Vec3 t = normalized(bone(thigh));
    Vec3 hinge = b.pelvis.b;
    if (const auto aux = s.map.aux.find(thigh); aux != s.map.aux.end()) {
      const Vec3 middle = 0.5 * (to_ours * (s.point(s.map.bones.at(thigh)[0]) + s.point(s.map.bones.at(thigh)[1])));
      hinge = leftFrom(aux->second.second, t, to_ours * s.point(aux->second.first) - middle);
    }
    b.leg[side] = {t, normalized(bone(sided("shank", side))), hinge};
    b.foot[side] = normalized(bone(sided("foot", side)));
  }
  addArms(s, to_ours, b);
  return b;
}

}  // namespace

CapturedMotion recordMarkers(const MarkerTable& table, const JointMap& map, const OsimModel* model, const Human& human,
                             const std::optional<WorldAxes>& world) {
  if (map.kind == MapKind::markers && !model)
    throw InputError({table.file, 0, "model"},
                     "has no markers at the joints: name the subject's scaled OpenSim model (.osim) as \"model\"");
  const LimbJoints joints = limbJoints(human.skeleton);
  const Mat3 to_ours = world ? axesOf(world->forward, world->up) : axesOf(map.forward, map.up);
  CapturedMotion r;
  r.file = table.file, r.map = map.name, r.times = table.times, r.notes = table.notes;
  Source s{table, map};
  double legs = 0;
  for (s.frame = 0; s.frame < table.times.size(); ++s.frame) {
    addDirections(r, human, joints,
                  map.kind == MapKind::markers ? fromModel(s, *model, to_ours) : fromPoints(s, to_ours));
    if (map.kind == MapKind::points)
      for (const char* bone : {"thigh_right", "shank_right", "thigh_left", "shank_left"})
        legs += 0.5 * norm(s.point(map.bones.at(bone)[1]) - s.point(map.bones.at(bone)[0]));
  }
  if (map.kind == MapKind::markers) {
    r.leg_m = norm(model->body(map.bodies.at("shank_right")).originAt(0)) +
              norm(model->body(map.bodies.at("ankle_right")).originAt(0));
  } else {
    r.leg_m = legs / static_cast<double>(table.times.size());
  }
  return r;
}

}  // namespace gambeson
