#pragma once
/// The virtual laboratory: specimens of a fabric on Kawabata's instruments, each step an equilibrium of the same cloth
/// that garments are made of. The instruments are those of S. Kawabata, The standardization and analysis of hand
/// evaluation, 2nd ed., Osaka 1980.

#include <vector>

#include "cases/cloth/kind.hpp"
#include "core/material/fabric.hpp"

namespace gambeson::laboratory {

/// How a specimen is cut and computed. What is simulated is a strip out of the middle of one that is wide against its
/// length (KES: 20 cm to 1 cm in bending, to 5 cm in shear): its points across the width move alike, so that it bends
/// to a cylinder, and shears alike everywhere; the free sides are left out. The instrument holds it upright: no weight.
struct Specimen {
  ClothModel cloth;
  int cells = 16;            ///< between the clamps
  int degree = 2;            ///< of NURBS
  double direction_rad = 0;  ///< from the weft towards the warp: in which it is bent, or pulled
};

/// A point of a loop, in the order in which it was measured.
struct LoopPoint {
  double at = 0;             ///< curvature [1/m], or shear angle [rad]
  double load = 0;           ///< moment per width [N], or shear force per width [N/m]
  double lost_J_per_m2 = 0;  ///< by the cloth's laws since the start
};
using Loop = std::vector<LoopPoint>;

/// From 0 to each of `turns` in steps of at most `step`, and through all of `also` that lie between.
struct Course {
  std::vector<double> turns;
  double step = 0;
  std::vector<double> also;
  /// All values on the way.
  std::vector<double> values() const;
};

/// KES-FB2, pure bending: 1 cm between the clamps. One clamp is still; about the other a moment turns, free of force,
/// until the middle of the specimen (all but a cell at either clamp) has the curvature that is wanted. The specimen
/// keeps its length, as the instrument sees to. Throws RunError where no equilibrium is found.
Loop bend(const Fabric& fabric, const Specimen& specimen, const Course& curvature_per_m);

/// KES-FB1, shear: 5 cm between the clamps, under a tension of 10 gf/cm; one clamp moves sideways by tan(angle) of
/// these 5 cm. The force is without the tension's part, F - W dy/dx along the specimen as it is: W tan(angle) where the
/// tension does not stretch it.
Loop shear(const Fabric& fabric, const Specimen& specimen, const Course& angle_rad);

/// Where a loop passes a place on a way: 0 is that to the first turn, 1 that to the second, and so on. Throws RunError
/// where it does not.
double loadAt(const Loop& loop, int way, double at);

/// What KES reads: the slope between two places, and the width at places, each the mean of both sides. `loop`: of a
/// course to +end, -end and +end.
double slopeBetween(const Loop& loop, double from, double to);
double widthAt(const Loop& loop, double at);

}  // namespace gambeson::laboratory
