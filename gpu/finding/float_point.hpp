#pragma once
/// Moving points in single precision, and what their boxes say of a pair: most pairs whose boxes in space meet are
/// apart in how they move relative to each other, and half of the bytes show it.

#include "gpu/finding/float_box.hpp"

namespace gambeson::gpu {

struct alignas(16) FloatPoint {
  float start[3], end[3];
  float error_m;  ///< of each coordinate, at most
  float unused;
};

GAMBESON_HD inline FloatPoint floatPoint(const MovingPoint& p) {
  FloatPoint f{};
  double largest = 0;
  for (int k = 0; k < 3; ++k) {
    f.start[k] = static_cast<float>(p.start[k]);
    f.end[k] = static_cast<float>(p.end[k]);
    largest = std::max(std::max(largest, std::abs(p.start[k])), std::abs(p.end[k]));
  }
  // Half a unit in the last place; numbers next to zero are off by less than the least normal one.
  f.error_m = 0x1p-24f * roundedUp(largest, 0) + std::numeric_limits<float>::min();
  return f;
}

/// Whether the differences between the corners of the two primitives, over the step, lie on one side of the separation
/// along an axis: as certified::Query::boxesApart says it, or not so. N: 3 for a point and a triangle, 4 for two edges.
///
/// A difference is off by both errors and by its own rounding, which is no more than these: 4 errors in all. 8 are
/// taken off.
template <int N>
GAMBESON_HD bool surelyApart(const FloatPoint (&p)[4], float separation_m) {
  const float error = std::max(std::max(p[0].error_m, p[1].error_m), std::max(p[2].error_m, p[3].error_m));
  const float limit = -nextBelow(-(separation_m + 8 * error));
  bool apart = false;
  for (int k = 0; k < 3; ++k) {
    float lo = std::numeric_limits<float>::infinity(), hi = -lo;
    for (int i = 0; i < N; ++i) {
      const FloatPoint &a = p[N == 3 ? 0 : i / 2], &b = p[N == 3 ? 1 + i : 2 + i % 2];
      const float start = a.start[k] - b.start[k], end = a.end[k] - b.end[k];
      lo = std::min(std::min(lo, start), end);
      hi = std::max(std::max(hi, start), end);
    }
    apart |= lo > limit || hi < -limit;
  }
  return apart;
}

}  // namespace gambeson::gpu
