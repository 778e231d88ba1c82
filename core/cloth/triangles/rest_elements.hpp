#pragma once
/// The elements of a cloth of triangles at rest.

#include <array>

#include "core/cloth/draft/bending_elements.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// A triangle at rest.
struct MembraneTriangle {
  std::array<int, 3> corner{};
  /// d(barycentric)/d(weft, warp): F D_weft = (x1 - x0) g[0].x + (x2 - x0) g[1].x, F D_warp with y [1/m].
  std::array<Vec2, 2> g{};
  double area_m2 = 0;
  int law = 0;
  BendingElements bending = BendingElements::hinge;  ///< as its garment bends
  double bending_spring_N_per_m = 0;                 ///< of its crossed springs; 0: from the fabric's rigidities
};

/// An edge between two triangles at rest; see TriangleCloth.
struct FoldHinge {
  std::array<int, 4> corner{};  ///< as foldAngle has them
  std::array<int, 2> triangle{};
  double theta0 = 0;     ///< [rad]
  double per_angle = 0;  ///< kappa over theta - theta0 [1/m]
  double area_m2 = 0;
  Vec3 d;  ///< (n1^2, n2^2, 2 n1 n2)
  int law = 0;
  bool seam = false;  ///< between two patches
};

}  // namespace gambeson
