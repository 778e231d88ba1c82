#pragma once
/// What a round specimen covers of the plane below it, seen from straight above.

#include <array>
#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson::laboratory {

/// Along rays that leave the axis x = y = 0 at equal angles, the first half an angle from x.
struct Shadow {
  double area_m2 = 0;           ///< outside the support; cloth that lies over cloth counts once
  std::vector<double> reach_m;  ///< of each ray, how far out it is covered; the support's radius where nothing is
};

/// Of triangles, seen along z, about a support of this radius. The same triangles always give the same area, so that
/// shares of areas are free of what rays miss between each other; a ray is exact along itself.
Shadow shadowOf(std::span<const Vec3> points, std::span<const std::array<int, 3>> triangles, double support_m,
                int rays);

/// Direction of ray k.
Vec2 rayAt(int k, int rays);

/// Folds: how often the reach rises and falls around the axis by more than `least_m`.
int nodesOf(std::span<const double> reach_m, double least_m);

}  // namespace gambeson::laboratory
