#pragma once
/// When a moving point meets a moving triangle, for meshes that deform (Zheng 2013, section 3.3.1, eq. 3.22).

#include <array>
#include <optional>

#include "core/math/vec.hpp"

namespace gambeson {

struct MovingHit {
  double time = 0;   ///< in [0, 1]
  Vec3 weights{};    ///< of the corners at the closest point at that time, sum 1
  double gap_m = 0;  ///< separation at that time: at most 2e-13 of the extent of the positions
};

/// First time in [0, 1] at which the point p0 -> p1 meets the triangle corner0 -> corner1, all moving straight at
/// constant speed. The coplanar times are where the cubic of eq. 3.22 vanishes: it is held in Bernstein form, split
/// into monotone pieces at the roots of its derivative, and each piece gives the window in which it is zero to within
/// its rounding error (all of [0, 1] for a motion in a plane). Within a window times are excluded by conservative
/// advancement: a distance at mid-window larger than the relative motion in half of it cannot vanish there.
/// Conservative: a true hit is not missed, a pass closer than 2e-13 of the extent of the positions may be reported. Not
/// certified: the error bounds are those of the formulas, not of every operation.
std::optional<MovingHit> movingPointTriangle(const Vec3& p0, const Vec3& p1, const std::array<Vec3, 3>& corner0,
                                             const std::array<Vec3, 3>& corner1);

/// Real intervals of [0, 1] in which |cubic| <= zero, in ascending order; the cubic by its Bernstein coefficients.
struct TimeWindows {
  struct Window {
    double begin, end;
  };
  std::array<Window, 3> window;
  int count = 0;
};
TimeWindows zerosOfCubic(const std::array<double, 4>& bernstein, double zero);

}  // namespace gambeson
