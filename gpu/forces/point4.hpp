#pragma once
/// Points of 32 bytes, and vectors with multiply-adds that are written as such.

#include <cmath>

#include "core/math/vec.hpp"

namespace gambeson::gpu {

/// A position [m] with the weight of its control point, or a force [N] with 0: two loads of 16 bytes.
struct alignas(32) Point4 {
  double x = 0, y = 0, z = 0, w = 0;
};

GAMBESON_HD inline Vec3 vec(const Point4& p) { return {p.x, p.y, p.z}; }

/// s a + b, rounded once in each component.
GAMBESON_HD inline Vec3 fma(double s, const Vec3& a, const Vec3& b) {
  return {::fma(s, a.x, b.x), ::fma(s, a.y, b.y), ::fma(s, a.z, b.z)};
}
GAMBESON_HD inline double fusedDot(const Vec3& a, const Vec3& b) { return ::fma(a.z, b.z, ::fma(a.y, b.y, a.x * b.x)); }
GAMBESON_HD inline Vec3 fusedCross(const Vec3& a, const Vec3& b) {
  return {::fma(a.y, b.z, -(a.z * b.y)), ::fma(a.z, b.x, -(a.x * b.z)), ::fma(a.x, b.y, -(a.y * b.x))};
}

}  // namespace gambeson::gpu
