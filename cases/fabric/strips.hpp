#pragma once
/// Instruments of the virtual laboratory that pull strips, and one that lets them droop.

#include <vector>

#include "cases/fabric/laboratory.hpp"
#include "core/math/vec.hpp"

namespace gambeson::laboratory {

/// KES-FB1, tension: 5 cm between the clamps, wide against that: the strip keeps its width. Engineering strains in the
/// order of `strain`, and the force per width at rest [N/m] of each.
Loop pull(const Fabric& fabric, const Specimen& specimen, const Course& strain);

/// The same of a long narrow strip, out of the middle of which the specimen is: its sides are free and its clamps
/// stay parallel. Along the bias (direction_rad pi/4) that is FAST-3's test of shear.
Loop pullFree(const Fabric& fabric, const Specimen& specimen, const Course& strain);

/// ASTM D1388: a strip slides over an edge until the chord of its overhang slopes by 41.5 degrees under its weight;
/// half of that overhang is the bending length [m]. `expected_m` is where it is sought, from a tenth to ten times.
/// Peirce's half is that of the elastica to 0.02 %: it has W g L^3/B = 8.004 there.
struct Droop {
  double length_m = 0;      ///< c
  std::vector<Vec3> shape;  ///< points of the overhang, from the edge on
};
Droop droop(const Fabric& fabric, const Specimen& specimen, double expected_m);

/// The chord's slope at which D1388 reads.
constexpr double kDroop_rad = 41.5 * 0.017453292519943295;

}  // namespace gambeson::laboratory
