#pragma once
/// How near is near enough for a contact.

#include <algorithm>

#include "core/math/vec.hpp"

namespace gambeson {

/// Distance within which contacts between cloth of this thickness are kept, and the distance at rest within which
/// points of one garment are neighbours.
GAMBESON_HD constexpr double contactReach(double layer_m) { return 1.1 * layer_m; }
/// The most that the cloth between the samples asks for as distance of these from a body.
constexpr double kLargestClearance_m = 2.5e-3;
GAMBESON_HD inline double neighbourDistance(double layer_m) { return 2 * layer_m; }

/// A point that moves straight by `way` comes less than `reach` from the origin, starting at `from`.
GAMBESON_HD inline bool comesWithin(double reach, const Vec3& from, const Vec3& way) {
  const double way2 = norm2(way), t = way2 > 0 ? std::clamp(-dot(from, way) / way2, 0.0, 1.0) : 0;
  return norm2(from + t * way) < reach * reach;
}

}  // namespace gambeson
