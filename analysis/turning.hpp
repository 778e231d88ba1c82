#pragma once
/// How fast bodies of single masses turn.

#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// Of masses m at x that move with v, about their centre X, which moves with V:
///   L = sum m (x - X) x (v - V),   w = I^-1 L,   I = sum m (|x - X|^2 1 - (x - X)(x - X)^T)
/// (H. Goldstein, Classical Mechanics, 2nd ed., sections 1.2 and 5.3). L changes with the torque alone. w is how fast
/// what is rigid turns; of all rigid motions it is the one nearest to the velocities, by mass.
struct Turning {
  Vec3 momentum_Nms;    ///< L
  Vec3 rate_rad_per_s;  ///< w; NaN where the masses lie on a line
};

/// Of the masses of each region.
std::vector<Turning> turningOf(std::span<const int> region, std::span<const double> mass_kg, std::span<const Vec3> x_m,
                               std::span<const Vec3> v_m_per_s, int regions);

}  // namespace gambeson
