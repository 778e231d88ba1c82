#pragma once
/// Files written from our own walk, as others would write them.

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>

#include "human/body/body.hpp"
#include "human/files/units.hpp"
#include "human/motion/motion.hpp"
#include "human/recorded/captured_motion.hpp"

namespace gambeson::test {

inline constexpr double rate_Hz = 100;

/// gait2392's columns of a motion.
inline std::string motOf(const Motion& motion, const Human& human, const JointMap& map, double from, double to,
                         bool degrees) {
  std::string s =
      fmt::format("walk\nversion=1\nnRows=7\nnColumns=7\ninDegrees={}\nendheader\ntime", degrees ? "yes" : "no");
  for (const auto& [coordinate, axis] : map.turns) s += "\t" + coordinate;
  for (const auto& name : map.position) s += "\t" + name;
  for (const auto& [joint, drive] : map.joints) s += "\t" + drive.from;
  s += "\n";
  const Mat3 A = axesOf(map.forward, map.up);
  const double unit = degrees ? rad_per_deg : 1;
  for (int i = 0; i <= std::lround((to - from) * rate_Hz); ++i) {
    const double t = from + i / rate_Hz;
    const Posture p = motion.at(t);
    const Mat3 R = transpose(A) * p.root.rotation * A;
    const auto angles = threeAngles(R, {map.turns[0].second, map.turns[1].second, map.turns[2].second});
    const Vec3 x = transpose(A) * p.root.origin - R * map.hips_m;
    s += fmt::format("{:.9f}", t);
    for (const double a : angles) s += fmt::format("\t{:.10f}", a / unit);
    for (int k = 0; k < 3; ++k) s += fmt::format("\t{:.10f}", x[k]);
    for (const auto& [joint, drive] : map.joints)
      s += fmt::format("\t{:.10f}", (p.q[human.skeleton.joint(joint)] - drive.offset_rad) / drive.scale / unit);
    s += "\n";
  }
  return s;
}

/// A .trc in millimetres, x forward, y up: points of links by name.
struct MarkerOn {
  std::string name, link;
  Vec3 at;  ///< in the link's frame
};
inline std::string trcOf(const Motion& motion, const Human& human, const std::vector<MarkerOn>& markers, double from,
                         double to) {
  std::string s = fmt::format(
      "PathFileType\t4\t(X/Y/"
      "Z)\twalk.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n100\t100\t900\t{}\tmm\nFrame#\tTime",
      markers.size());
  for (const MarkerOn& m : markers) s += "\t" + m.name + "\t\t";
  s += "\n\t";
  for (std::size_t k = 1; k <= markers.size(); ++k) s += fmt::format("\tX{0}\tY{0}\tZ{0}", k);
  s += "\n\n";
  const Mat3 A = axesOf({1, 0, 0}, {0, 1, 0});
  for (int i = 0; i <= std::lround((to - from) * rate_Hz); ++i) {
    const double t = from + i / rate_Hz;
    const Posture p = motion.at(t);
    const auto X = linkPoses(human.skeleton, p.q, p.root);
    s += fmt::format("{}\t{:.9f}", i + 1, t);
    for (const MarkerOn& m : markers) {
      const Vec3 x = 1e3 * (transpose(A) * (X[human.skeleton.link(m.link)] * m.at));
      s += fmt::format("\t{:.7f}\t{:.7f}\t{:.7f}", x.x, x.y, x.z);
    }
    s += "\n";
  }
  return s;
}

}  // namespace gambeson::test
