#pragma once
/// How an obstacle is moved: courses of its velocity and of its spin.

#include <algorithm>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// A quantity over time, linear between its rows; nothing before the first, the last value after the last.
template <class T>
struct DriveProgram {
  std::vector<double> time_s;  ///< ascending
  std::vector<T> value;

  bool empty() const { return time_s.empty(); }
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

struct ObstacleDrive {
  DriveProgram<Vec3> velocity_m_per_s;
  DriveProgram<double> spin_rad_per_s;  ///< about `axis` (unit) through `center`, which moves along
  Vec3 axis{0, 0, 1}, center_m;

  bool empty() const { return velocity_m_per_s.empty() && spin_rad_per_s.empty(); }
  /// From where the obstacle stands at rest to where it is at t: x = pose X.
  Pose at(double t) const {
    const Mat3 R = spin_rad_per_s.empty() ? Mat3{} : rotationAbout(axis, spin_rad_per_s.upTo(t));
    return {R, center_m - R * center_m + velocity_m_per_s.upTo(t)};
  }
};

}  // namespace gambeson
