/// Detail of captured_motion.hpp: OpenSim coordinates as a captured motion: values by the map, without wraps.

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "human/files/units.hpp"
#include "human/motion/standing.hpp"
#include "human/recorded/captured_motion.hpp"

namespace gambeson {
namespace {

/// Beyond its limits by more than this a joint is not the one that the map takes it for, or has the wrong sign.
constexpr double limit_slack_rad = 35 * rad_per_deg;

const std::vector<double>& columnOf(const StorageTable& t, const std::string& name, const std::string& map) {
  const int c = t.column(name);
  if (c < 0) throw InputError({t.file, 0, name}, "is missing in the file; the map '" + map + "' asks for it");
  return t.columns[c];
}

void checkLimits(const StorageTable& t, const Joint& joint, const JointMap::Drive& d, const std::vector<double>& x) {
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!(x[i] >= joint.lower - limit_slack_rad && x[i] <= joint.upper + limit_slack_rad))
      throw InputError(
          {t.file, i < t.lines.size() ? t.lines[i] : 0, d.from},
          fmt::format("makes {} {:.1f} degrees, which bends {:.0f} to {:.0f}: does the map have its sign "
                      "right, and the header its unit?",
                      joint.name, x[i] / rad_per_deg, joint.lower / rad_per_deg, joint.upper / rad_per_deg));
}

}  // namespace

CapturedMotion recordAngles(const StorageTable& table, const JointMap& map, const Human& human,
                            const std::optional<WorldAxes>& world) {
  const Skeleton& s = human.skeleton;
  CapturedMotion r;
  r.file = table.file, r.map = map.name, r.times = table.times, r.notes = table.notes, r.model_leg_m = map.leg_m;
  r.driven.assign(s.joints.size(), false);
  r.q.assign(table.times.size(), standing(human).q);
  const double unit = table.in_degrees ? rad_per_deg : 1;
  for (const auto& [name, drive] : map.joints) {
    const int j = s.joint(name);
    if (j < 0) throw InputError({map.name, 0, "joints." + name}, "the skeleton has no such joint");
    if (s.joints[j].type != JointType::revolute || s.joints[j].mimic_of)
      throw InputError({map.name, 0, "joints." + name}, "the joint does not turn by itself");
    if (drive.optional && table.column(drive.from) < 0) continue;
    const auto& column = columnOf(table, drive.from, map.name);
    std::vector<double> x;
    for (const double v : column) {
      double a = drive.scale * unit * v + drive.offset_rad;
      const double before =
          x.empty() ? 0.5 * (std::max(s.joints[j].lower, -10.0) + std::min(s.joints[j].upper, 10.0)) : x.back();
      a += 2 * std::numbers::pi * std::round((before - a) / (2 * std::numbers::pi));
      x.push_back(a);
    }
    checkLimits(table, s.joints[j], drive, x);
    for (std::size_t i = 0; i < x.size(); ++i) r.q[i][j] = x[i];
    r.driven[j] = true;
  }
  const Mat3 body = axesOf(map.forward, map.up), to_ours = world ? axesOf(world->forward, world->up) : body;
  std::array<const std::vector<double>*, 3> turn{}, position{};
  for (int k = 0; k < 3; ++k) {
    turn[k] = &columnOf(table, map.turns[k].first, map.name);
    position[k] = &columnOf(table, map.position[k], map.name);
  }
  for (std::size_t i = 0; i < table.times.size(); ++i) {
    Mat3 R;
    for (int k = 0; k < 3; ++k) R = R * rotationAbout(map.turns[k].second, unit * (*turn[k])[i]);
    const Vec3 p{(*position[0])[i], (*position[1])[i], (*position[2])[i]};
    r.pelvis.push_back(to_ours * R * transpose(body));
    r.hips.push_back(to_ours * (p + R * map.hips_m));
  }
  return r;
}

}  // namespace gambeson
