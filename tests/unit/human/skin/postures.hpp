#pragma once
/// Postures that fold a skin, and what must hold in them.

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "core/contact/contact_mesh.hpp"
#include "core/contact/crossing.hpp"
#include "human/body/skin.hpp"
#include "human/files/units.hpp"
#include "human/motion/motion.hpp"
#include "human/motion/standing.hpp"

namespace gambeson {

using Angles = std::map<std::string, double>;  ///< of joints [degrees]; the others as in standing

inline std::vector<Vec3> posed(const Human& h, const Skin& s, const Angles& angles) {
  Posture p = standing(h);
  for (const auto& [joint, deg] : angles) p.q.at(h.skeleton.joint(joint)) = deg * rad_per_deg;
  std::vector<Vec3> x(s.rest.vertices.size());
  skinPositions(s, linkPoses(h.skeleton, p.q, p.root), x);
  return x;
}

/// The end of aiming and its begin: motion_aiming_kneeling.json of the public data, "end_aim_at_ground_lean_left" with
/// the pelvis's tilt left out, "start_low_ready".
inline const Angles aiming{{"hip_flexion_left", 95},       {"hip_flexion_right", 70},
                           {"hip_adduction_left", -10},    {"hip_adduction_right", -8},
                           {"hip_rotation_left", -5},      {"hip_rotation_right", -5},
                           {"knee_flexion_left", 75},      {"knee_flexion_right", 70},
                           {"ankle_flexion_left", 20},     {"ankle_flexion_right", 20},
                           {"lumbar_flexion", 35},         {"lumbar_bending", -12},
                           {"lumbar_rotation", 8},         {"shoulder_flexion_left", 80},
                           {"shoulder_abduction_left", 5}, {"elbow_flexion_left", 50},
                           {"shoulder_flexion_right", 45}, {"shoulder_abduction_right", 40},
                           {"elbow_flexion_right", 110},   {"neck_flexion", 15}};
inline const Angles low_ready{
    {"hip_flexion_left", 5},     {"hip_flexion_right", 5},       {"hip_adduction_left", -3},
    {"hip_adduction_right", -3}, {"knee_flexion_left", 5},       {"knee_flexion_right", 5},
    {"lumbar_flexion", 5},       {"shoulder_flexion_left", 30},  {"shoulder_abduction_left", 10},
    {"elbow_flexion_left", 80},  {"shoulder_flexion_right", 10}, {"shoulder_abduction_right", 20},
    {"elbow_flexion_right", 95}};
inline const Angles stairs{{"hip_flexion_left", 70},  {"knee_flexion_left", 90},  {"ankle_flexion_left", 15},
                           {"hip_flexion_right", -5}, {"elbow_flexion_left", 40}, {"elbow_flexion_right", 40}};
inline const Angles folded{
    {"knee_flexion_left", 110}, {"knee_flexion_right", 110}, {"elbow_flexion_left", 115}, {"elbow_flexion_right", 115}};

inline Angles between(const Angles& a, const Angles& b, double u) {
  Angles c = a;
  for (const auto& [joint, deg] : b) c[joint] = deg;
  for (auto& [joint, deg] : c) {
    const auto at = [&, &name = joint](const Angles& m) { return m.contains(name) ? m.at(name) : 0.0; };
    deg = (1 - u) * at(a) + u * at(b);
  }
  return c;
}

inline std::size_t crossings(const Skin& s, const std::vector<Vec3>& x) {
  const ContactMesh mesh = contactMesh(static_cast<int>(x.size()), s.rest.triangles);
  return findCrossings(mesh, x).size();
}

/// The smallest distance of a vertex from one that it faces (normals opposed) within 20 mm but more than 30 mm away at
/// rest: the narrowest fold. 20 mm where there is none. `which` tells what pairs count.
template <class Which>
double narrowest(const Skin& s, const std::vector<Vec3>& x, Which which) {
  constexpr double reach = 0.02;
  std::vector<Vec3> normal(x.size());
  for (const auto& t : s.rest.triangles)
    for (const int v : t) normal[v] += cross(x[t[1]] - x[t[0]], x[t[2]] - x[t[0]]);
  for (Vec3& n : normal) n = normalized(n);
  std::vector<int> order(x.size());
  for (std::size_t v = 0; v < x.size(); ++v) order[v] = static_cast<int>(v);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return x[a].z < x[b].z; });
  double least = reach;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && x[order[j]].z - x[order[i]].z < reach; ++j) {
      const int v = order[i], w = order[j];
      const Vec3 d = x[w] - x[v];
      if (norm2(d) > reach * reach || dot(normal[v], normal[w]) > -0.7) continue;
      const double h = dot(d, normal[v]);
      if (h < 0.5 * norm(d) || norm(s.rest.vertices[w] - s.rest.vertices[v]) < 0.03 || !which(v, w)) continue;
      least = std::min(least, norm(d));
    }
  return least;
}
inline double narrowest(const Skin& s, const std::vector<Vec3>& x) {
  return narrowest(s, x, [](int, int) { return true; });
}

}  // namespace gambeson
