#pragma once
/// Boxes in single precision, rounded outwards: most of finding is to compare them.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "core/math/vec.hpp"

namespace gambeson::gpu {

/// A point over a step: straight from start to end, at constant speed.
struct alignas(16) MovingPoint {
  Vec3 start, end;
};

/// Positions below 3e38 m.
struct alignas(8) FloatBox {
  float lo[3], hi[3];
};

/// The next smaller number; of minus infinity itself.
GAMBESON_HD inline float nextBelow(float x) {
  if (x == 0) return -std::numeric_limits<float>::denorm_min();
  if (!(x > -std::numeric_limits<float>::infinity())) return x;
  const std::int32_t bits = std::bit_cast<std::int32_t>(x);
  return std::bit_cast<float>(x > 0 ? bits - 1 : bits + 1);
}

/// The largest number of single precision that is at most x - margin, or the one below it where there is a margin.
GAMBESON_HD inline float roundedDown(double x, float margin) {
  float down = static_cast<float>(x);
  if (static_cast<double>(down) > x) down = nextBelow(down);
  return margin > 0 ? nextBelow(down - margin) : down;
}
GAMBESON_HD inline float roundedUp(double x, float margin) { return -roundedDown(-x, margin); }

/// The way of a point over the step, and all within the margin of it along each axis.
GAMBESON_HD inline FloatBox boxOf(const MovingPoint& p, float margin) {
  FloatBox box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = roundedDown(std::min(p.start[k], p.end[k]), margin);
    box.hi[k] = roundedUp(std::max(p.start[k], p.end[k]), margin);
  }
  return box;
}

/// A box that meets none.
GAMBESON_HD inline FloatBox emptyBox() {
  constexpr float kFar = std::numeric_limits<float>::infinity();
  return {{kFar, kFar, kFar}, {-kFar, -kFar, -kFar}};
}

GAMBESON_HD inline FloatBox joined(const FloatBox& a, const FloatBox& b) {
  FloatBox box;
  for (int k = 0; k < 3; ++k) {
    box.lo[k] = b.lo[k] < a.lo[k] ? b.lo[k] : a.lo[k];
    box.hi[k] = b.hi[k] > a.hi[k] ? b.hi[k] : a.hi[k];
  }
  return box;
}

/// Boxes that touch meet.
GAMBESON_HD inline bool meet(const FloatBox& a, const FloatBox& b) {
  return (a.lo[0] <= b.hi[0]) & (a.lo[1] <= b.hi[1]) & (a.lo[2] <= b.hi[2]) & (b.lo[0] <= a.hi[0]) &
         (b.lo[1] <= a.hi[1]) & (b.lo[2] <= a.hi[2]);
}

}  // namespace gambeson::gpu
