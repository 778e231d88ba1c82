#pragma once
/// Springs between the points of cloth on patches of degree 1 (Man 2006, sections 2.1.1.1 and 2.2, after Provot,
/// Graphics Interface 1995).
///
/// The points of a patch lie in a grid. Structural springs join neighbours, shear springs the diagonals of each cell,
/// flexion springs every second point of a line. Each pulls by eq. 2.1,
///   f_i = k (|d| - l0) d/|d|,  d = x_j - x_i,  f_j = -f_i,
/// l0 its length at rest (core/material/laws/spring.hpp). Beside a border a line of springs stands for half of what it
/// stands for inside, and has half of the stiffness. Square cells, n by n of them, have at rest
///   A11 = A22 = ks + kd + 4 kf (n - 1)/n,  A12 = A66 = kd  [N/m],
/// whatever their size: Poisson's ratio is no number of such cloth. Flexion springs are flat to first order in what
/// they bend by, so their energy goes with the fourth power of a curvature.
///
/// From a fabric, cell by cell of the sides a and b: kd = A66 (a² + b²)/(2 a b), kf as stores what the fabric's
/// rigidity does at a curvature of 1/cm (or folded by a right angle, where that is less; too little below, too much
/// beyond), and ks what A11 asks for beside both. Cells so long that shear springs alone are stiffer than the fabric
/// along them are refused.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Stiffnesses in N/m; 0: from the fabric.
struct SpringNumbers {
  double structural_N_per_m = 0, shear_N_per_m = 0, flexion_N_per_m = 0;
};

/// One spring.
struct PointSpring {
  std::array<int, 2> corner{};  ///< control points of the garment
  double rest_m = 0, stiffness_N_per_m = 0;
  bool bends = false;  ///< a flexion spring
};

/// What the springs of one cell amount to: in its plane it stretches as their mean over its area does.
struct SpringCell {
  struct Line {
    Vec2 way;                      ///< at rest, along (weft, warp) [m]
    double stiffness_N_per_m = 0;  ///< of the springs along it, as far as the cell has a part in them
  };
  std::array<Line, 6> lines{};  ///< structural, flexion along u and v; both diagonals
  double area_m2 = 0;
};

struct SpringNet {
  std::vector<PointSpring> springs;
  std::vector<SpringCell> cells;   ///< of all patches, u fastest
  std::vector<int> first_cell{0};  ///< of each patch, one more than there are patches
};

/// The springs of a garment. Its patches are of degree 1, without trims and without weights, its seams C0 joints of
/// whole edges; across a seam flexion springs join the points beside it. Throws InputError where it is otherwise, and
/// where a fabric cannot be made of such springs.
SpringNet springNet(const Garment& garment, const SpringNumbers& numbers = {});

/// The second Piola-Kirchhoff resultants (n11, n22, n12) [N/m] of a cell under the Green-Lagrange strain (E11, E22,
/// 2 E12), the derivative of what its springs store under a uniform stretch, over its area.
Vec3 resultantsOf(const SpringCell& cell, const Vec3& strain);
/// The moments (m11, m22, m12) [N] of a cell bent by the curvature (k11, k22, 2 k12) [1/m], likewise of what its
/// flexion springs store over arcs whose chords keep their length. Beyond a right angle between chords, as there.
Vec3 momentsOf(const SpringCell& cell, const Vec3& curvature);

}  // namespace gambeson
