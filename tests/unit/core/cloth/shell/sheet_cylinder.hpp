#pragma once
/// An exact rational piece of a cylinder for the tests of core/cloth.

#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson::shapes {

/// A quarter of a cylinder about z: u the angle from x to y, v along z over [0, length]; a3 points outwards.
/// `cells` knot cells in u.
inline NurbsPatch quarterCylinder(double radius, double length, int cells) {
  NurbsPatch s{uniformKnots(2, 1), uniformKnots(2, 2), {}, {}};
  for (double b : grevillePoints(s.v))
    for (int i = 0; i < 3; ++i) {
      s.points.push_back({i == 2 ? 0 : radius, i == 0 ? 0 : radius, length * b});
      s.weights.push_back(i == 1 ? std::sqrt(0.5) : 1);
    }
  for (int i = 1; i < cells; ++i) s = insertKnot(s, Direction::u, static_cast<double>(i) / cells);
  return s;
}

}  // namespace gambeson::shapes
