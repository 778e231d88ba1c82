#pragma once
/// Rotations without functions of a mathematics library.

#include "core/math/vec.hpp"

namespace gambeson::gpu {

/// A turn about an axis through the origin by the angle whose half has this tangent.
inline Mat3 turnBy(const Vec3& axis, double tangent_of_half) {
  const double w = 1 / std::sqrt(1 + tangent_of_half * tangent_of_half);
  const Vec3 v = (tangent_of_half * w) * normalized(axis);
  const auto turned = [&](const Vec3& p) {
    const Vec3 t = 2 * cross(v, p);
    return p + w * t + cross(v, t);
  };
  return {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})};
}

}  // namespace gambeson::gpu
