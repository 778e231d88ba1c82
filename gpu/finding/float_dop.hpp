#pragma once
/// Polytopes of 18 faces in single precision, rounded outwards: a box, and slabs along the diagonals of its faces
/// (18-DOPs: Klosowski and others 1998; Wong 2014, section 5.3). Of points at rest they are discrete, of moving ones
/// continuous.

#include "gpu/finding/float_box.hpp"

namespace gambeson::gpu {

constexpr int kSlabs = 9;

struct alignas(8) FloatDop {
  float lo[kSlabs], hi[kSlabs];
};

/// Along x, y, z, x + y, x - y, x + z, x - z, y + z, y - z, whose lengths are 1 and sqrt(2).
GAMBESON_HD inline void alongSlabs(const Vec3& p, double (&at)[kSlabs]) {
  at[0] = p.x, at[1] = p.y, at[2] = p.z;
  at[3] = p.x + p.y, at[4] = p.x - p.y;
  at[5] = p.x + p.z, at[6] = p.x - p.z;
  at[7] = p.y + p.z, at[8] = p.y - p.z;
}

/// The way of a point over the step and all within the margin of it: two points that come as near as both margins
/// together have polytopes that meet.
GAMBESON_HD inline FloatDop dopOf(const MovingPoint& p, float margin) {
  const float diagonal = roundedUp(margin * 1.4142135623730951, 0);
  double start[kSlabs], end[kSlabs];
  alongSlabs(p.start, start);
  alongSlabs(p.end, end);
  FloatDop dop;
  for (int k = 0; k < kSlabs; ++k) {
    dop.lo[k] = roundedDown(std::min(start[k], end[k]), k < 3 ? margin : diagonal);
    dop.hi[k] = roundedUp(std::max(start[k], end[k]), k < 3 ? margin : diagonal);
    if (k < 3) continue;
    dop.lo[k] = nextBelow(dop.lo[k]);  // sums have been rounded
    dop.hi[k] = -nextBelow(-dop.hi[k]);
  }
  return dop;
}

GAMBESON_HD inline FloatDop joined(const FloatDop& a, const FloatDop& b) {
  FloatDop dop;
  for (int k = 0; k < kSlabs; ++k) {
    dop.lo[k] = b.lo[k] < a.lo[k] ? b.lo[k] : a.lo[k];
    dop.hi[k] = b.hi[k] > a.hi[k] ? b.hi[k] : a.hi[k];
  }
  return dop;
}

/// Polytopes that touch meet.
GAMBESON_HD inline bool meet(const FloatDop& a, const FloatDop& b) {
  bool all = true;
  for (int k = 0; k < kSlabs; ++k) all &= (a.lo[k] <= b.hi[k]) & (b.lo[k] <= a.hi[k]);
  return all;
}

/// Of an edge (K = 2) or a face (K = 3).
template <int K>
GAMBESON_HD FloatDop primitiveDop(const int* corners, const FloatDop* vertex_dop) {
  FloatDop dop = vertex_dop[corners[0]];
  for (int k = 1; k < K; ++k) dop = joined(dop, vertex_dop[corners[k]]);
  return dop;
}

struct DopVertices {
  const MovingPoint* point;
  float margin_m;
  FloatDop* dop;
  GAMBESON_HD void operator()(int i) const { dop[i] = dopOf(point[i], margin_m); }
};

}  // namespace gambeson::gpu
