#pragma once
/// Boxes of points that move, in single precision, rounded outwards: most of a search for pairs is comparing them.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/contact/box.hpp"
#include "core/contact/four.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// What a list of candidates allows for: at times t in [0, horizon_s] vertex i is within slack_m[i] of the point
/// x[i] + t velocity[i]. Empty spans: zero.
struct ListedMotion {
  std::span<const Vec3> x, velocity_m_per_s;
  std::span<const double> slack_m;
  double horizon_s = 0;

  double slack(int i) const { return slack_m.empty() ? 0.0 : slack_m[i]; }
  Vec3 velocity(int i) const { return velocity_m_per_s.empty() ? Vec3{} : velocity_m_per_s[i]; }
};

/// A box of points, and a box of their ways until the horizon. Empty by default.
class MovingBox {
 public:
  MovingBox() = default;
  MovingBox(const ListedMotion& m, int i) {
    const Vec3 way = m.horizon_s * m.velocity(i);
    for (int k = 0; k < 3; ++k) {
      // Each is off by 2^-24 of itself, and the sums of `mayMeet` by a few times that.
      const double at = m.x[i][k], round = 1e-6 * (std::abs(at) + std::abs(way[k]) + m.slack(i)) + 1e-9;
      lo_[k] = static_cast<float>(at - m.slack(i) - round);
      hi_[k] = static_cast<float>(at + m.slack(i) + round);
      way_lo_[k] = way_hi_[k] = static_cast<float>(way[k]);
    }
    lo_[3] = hi_[3] = way_lo_[3] = way_hi_[3] = 0;
  }

  void add(const MovingBox& b) {
    lo_ = least(lo_, b.lo_), hi_ = most(hi_, b.hi_);
    way_lo_ = least(way_lo_, b.way_lo_), way_hi_ = most(way_hi_, b.way_hi_);
  }

  bool operator==(const MovingBox& b) const {
    return !any((lo_ != b.lo_) | (hi_ != b.hi_) | (way_lo_ != b.way_lo_) | (way_hi_ != b.way_hi_));
  }

  /// lo, hi, and the least and most of the ways, of x, y, z each.
  std::array<float, 12> numbers() const {
    return {lo_[0],     lo_[1],     lo_[2],     hi_[0],     hi_[1],     hi_[2],
            way_lo_[0], way_lo_[1], way_lo_[2], way_hi_[0], way_hi_[1], way_hi_[2]};
  }

  /// The box of points and of their ways.
  Box points() const {
    Box box;
    for (int k = 0; k < 3; ++k) {
      box.lo[k] = lo_[k] + std::min(0.0f, way_lo_[k]);
      box.hi[k] = hi_[k] + std::max(0.0f, way_hi_[k]);
    }
    return box;
  }

  /// Squared diagonal of the box of points.
  float size2() const {
    const Four d = hi_ - lo_;
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  }

  /// Points of the two boxes may come within `margin` of each other along each axis. Only how they move relative to
  /// each other counts: cloth that moves along together, however fast, stays apart.
  friend bool mayMeet(const MovingBox& a, const MovingBox& b, float margin) {
    const Four zero{};
    const Four up = most(zero, b.way_hi_ - a.way_lo_), down = least(zero, b.way_lo_ - a.way_hi_);
    const Four below = a.lo_ - margin, above = a.hi_ + margin;
    return !any((below > b.hi_ + up) | (b.lo_ + down > above));
  }

 private:
  static constexpr float kFar = std::numeric_limits<float>::infinity();

  Four lo_{kFar, kFar, kFar, kFar}, hi_{-kFar, -kFar, -kFar, -kFar}, way_lo_ = lo_, way_hi_ = hi_;
};

/// A single-precision number that is no less than x.
inline float roundUp(double x) { return std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity()); }

}  // namespace gambeson
