#pragma once
/// How an obstacle, or what a support holds, is moved: courses of velocity and of spin.

#include <algorithm>
#include <vector>

#include "core/contact/impact_zones.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// A quantity over time, linear between its rows; nothing before the first, the last value after the last.
template <class T>
struct DriveProgram {
  std::vector<double> time_s;  ///< ascending
  std::vector<T> value;

  bool operator==(const DriveProgram&) const = default;
  bool empty() const { return time_s.empty(); }
  T at(double t) const {
    const auto after = std::upper_bound(time_s.begin(), time_s.end(), t);
    if (after == time_s.begin()) return {};
    const auto k = static_cast<std::size_t>(after - time_s.begin()) - 1;
    if (after == time_s.end()) return value[k];
    return value[k] + (value[k + 1] - value[k]) * ((t - time_s[k]) / (time_s[k + 1] - time_s[k]));
  }
  /// Its integral up to t.
  T upTo(double t) const {
    T sum{};
    for (std::size_t k = 0; k < time_s.size() && t > time_s[k]; ++k) {
      const bool last = k + 1 == time_s.size();
      const double end = last ? t : std::min(t, time_s[k + 1]), way = end - time_s[k];
      const T slope = last ? T{} : (value[k + 1] - value[k]) * (1 / (time_s[k + 1] - time_s[k]));
      sum = sum + value[k] * way + slope * (0.5 * way * way);
    }
    return sum;
  }
};

struct Drive {
  DriveProgram<Vec3> velocity_m_per_s;
  DriveProgram<double> spin_rad_per_s;  ///< about `axis` (unit) through `center`, which moves along
  Vec3 axis{0, 0, 1}, center_m;

  bool operator==(const Drive&) const = default;
  bool empty() const { return velocity_m_per_s.empty() && spin_rad_per_s.empty(); }
  /// From where all stands before it moves to where it is at t: x = pose X.
  Pose at(double t) const {
    const Mat3 R = spin_rad_per_s.empty() ? Mat3{} : rotationAbout(axis, spin_rad_per_s.upTo(t));
    return {R, center_m - R * center_m + velocity_m_per_s.upTo(t)};
  }
  /// How it moves at t.
  RigidVelocity rateAt(double t) const {
    return {center_m + velocity_m_per_s.upTo(t), velocity_m_per_s.at(t), spin_rad_per_s.at(t) * axis};
  }
};

}  // namespace gambeson
