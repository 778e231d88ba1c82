#pragma once
/// Placements as core/math/vec.hpp has them, for kernels.

#include "core/math/vec.hpp"

namespace gambeson::gpu {

GAMBESON_HD inline Vec3 placed(const Placement& X, const Vec3& p) { return X.rotation * (X.scale * p) + X.origin; }
/// The point p with placed(X, p) = x.
GAMBESON_HD inline Vec3 toFrame(const Placement& X, const Vec3& x) {
  return transposeTimes(X.rotation, x - X.origin) / X.scale;
}

}  // namespace gambeson::gpu
