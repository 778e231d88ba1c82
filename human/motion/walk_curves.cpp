#include "human/motion/walk_curves.hpp"

#include <nlohmann/json.hpp>
#include <numeric>

#include "human/files/data.hpp"
#include "human/files/units.hpp"

namespace gambeson {
namespace {

using Values = std::vector<double>;

/// Drops the last value (phase 1) after spreading the closure error over the cycle.
Values closed(Values x) {
  const int n = static_cast<int>(x.size()) - 1;
  const double error = x[n] - x[0];
  for (int i = 0; i < n; ++i) x[i] -= error * (static_cast<double>(i) / n - 0.5);
  x.pop_back();
  return x;
}

/// (x(p) + sign x(p + 1/2)) / 2
Values halfStride(const Values& x, double sign) {
  Values y(x.size());
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) y[i] = 0.5 * (x[i] + sign * x[(i + n / 2) % n]);
  return y;
}

PeriodicSpline spline(Values x, double scale = 1, double offset = 0) {
  for (double& v : x) v = scale * (v + offset) * rad_per_deg;
  return PeriodicSpline(std::move(x));
}

double mean(const Values& x) { return std::accumulate(x.begin(), x.end(), 0.0) / static_cast<double>(x.size()); }

Values walkingTilt(const nlohmann::json& walk) {
  return halfStride(closed(walk.at("pelvis_tilt_deg").get<Values>()), 1);
}

}  // namespace

double pelvisZero_deg() { return mean(walkingTilt(nlohmann::json::parse(data::walk_natural))); }

WalkCurves naturalWalk() {
  const nlohmann::json walk = nlohmann::json::parse(data::walk_natural);
  const auto curve = [&](const char* name) { return closed(walk.at(name).get<Values>()); };
  const auto percent = [&](const char* name) { return walk.at(name).get<double>(); };

  const Values tilt = walkingTilt(walk);
  const double mean_tilt = mean(tilt);
  WalkCurves c;
  c.hip_flexion = spline(curve("hip_flexion_deg"), 1, mean_tilt);
  c.hip_adduction = spline(curve("hip_adduction_deg"));
  c.hip_rotation = spline(curve("hip_rotation_deg"));
  c.knee_flexion = spline(curve("knee_flexion_deg"));
  c.ankle_flexion = spline(curve("ankle_dorsiflexion_deg"));
  c.shoulder_flexion = spline(curve("shoulder_flexion_deg"));
  c.elbow_flexion = spline(curve("elbow_flexion_deg"));
  c.pelvis_yaw = spline(halfStride(curve("pelvis_rotation_deg"), -1));
  c.pelvis_roll = spline(halfStride(curve("pelvis_obliquity_deg"), -1), -1);  // right side up is + in the data
  c.pelvis_pitch = spline(tilt, -1, -mean_tilt);                              // anterior tilt is - in the data
  c.double_support = 0.5 / 100 *
                     (percent("contralateral_foot_off_percent") + percent("ipsilateral_foot_off_percent") -
                      percent("contralateral_foot_strike_percent"));
  return c;
}

StairCurves stairAscent() {
  const nlohmann::json stairs = nlohmann::json::parse(data::stairs_ascent);
  const auto curve = [&](const char* name) { return closed(stairs.at(name).get<Values>()); };
  const auto percent = [&](const char* name) { return stairs.at(name).get<double>(); };
  const double zero = pelvisZero_deg();
  StairCurves c;
  c.hip_flexion = spline(curve("hip_flexion_deg"), 1, zero);
  c.hip_adduction = spline(curve("hip_adduction_deg"));
  c.hip_rotation = spline(curve("hip_rotation_deg"));
  c.ankle_flexion = spline(curve("ankle_dorsiflexion_deg"));
  Values knee = curve("knee_flexion_deg");
  c.knee_flexion = spline(knee);
  const std::size_t n = knee.size();
  for (std::size_t i = n - n / 6; i < n; ++i) knee[i] = knee[0];
  c.knee_flexion_landed = spline(knee);
  c.pelvis_yaw = spline(halfStride(curve("pelvis_rotation_deg"), -1));
  c.pelvis_roll = spline(halfStride(curve("pelvis_obliquity_deg"), -1), -1);
  c.pelvis_pitch = spline(halfStride(curve("pelvis_tilt_deg"), 1), -1, -zero);
  c.foot_off = 0.5 + 0.5 / 100 *
                         (percent("contralateral_foot_off_percent") + percent("ipsilateral_foot_off_percent") -
                          percent("contralateral_foot_strike_percent"));
  return c;
}

}  // namespace gambeson
