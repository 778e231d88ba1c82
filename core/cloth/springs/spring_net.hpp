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
/// Flexion::buckling takes Choi and Ko's strip (eq. 2.10, core/material/laws/buckling_spring.hpp) in their place: its
/// energy goes with the square of the curvature, it resists from the start as a column does, and pulls nothing. Strips
/// over two cells overlap, and chords that keep their length bring their ends less close than an arc, so each has 2/3
/// of the rigidity B of its line: of a slightly bent cylinder they store B/2 kappa^2 per area together. They have then
/// no part in A11.
///
/// From a fabric, cell by cell of the sides a and b: kd = A66 (a² + b²)/(2 a b), kf as stores what the fabric
/// does at a curvature of 1/cm (or folded by a right angle, where that is less; too little below, too much
/// beyond), B what stores as much there, and ks what A11 asks for beside all. Cells so long that shear springs alone
/// are stiffer than the fabric along them are refused.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/springs/spring_numbers.hpp"
#include "core/material/laws/buckling_spring.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// One spring.
struct PointSpring {
  std::array<int, 2> corner{};  ///< control points of the garment
  double rest_m = 0, stiffness_N_per_m = 0;
  bool bends = false;  ///< a flexion spring
  int strip = -1;      ///< of SpringNet::strips, whose law it has; -1: Hooke's
};

/// What the springs of one cell amount to: in its plane it stretches as their mean over its area does.
struct SpringCell {
  struct Line {
    Vec2 way;                      ///< at rest, along (weft, warp) [m]
    double stiffness_N_per_m = 0;  ///< of the springs along it, as far as the cell has a part in them
    double rigidity_Nm2 = 0;       ///< k_b of strips that buckle along it; 0: there are none
  };
  std::array<Line, 6> lines{};  ///< structural, flexion along u and v; both diagonals
  double area_m2 = 0;
};

struct SpringNet {
  std::vector<PointSpring> springs;
  std::vector<BucklingSpring> strips;
  std::vector<SpringCell> cells;   ///< of all patches, u fastest
  std::vector<int> first_cell{0};  ///< of each patch, one more than there are patches

  /// Of a spring of this net, at the squared length [m^2].
  SpringAnswer<double> answer(const PointSpring& spring, double length2) const {
    return spring.strip < 0 ? linearSpring<all_parts>(spring.stiffness_N_per_m, spring.rest_m, length2)
                            : strips[static_cast<std::size_t>(spring.strip)].answer(length2);
  }
};

/// What a fabric has that springs have not, in words; empty where there is nothing. Jamming, which keeps pressed cloth
/// from being crushed to nothing, is left out of springs and is no such thing.
std::string whatSpringsLack(const Fabric& fabric);

/// The springs of a garment of nodes (core/cloth/draft/nodal_draft.hpp). Across a smooth seam (G1), and across one with
/// a spring of its own, whose stiffness is left out, flexion springs join the points beside it as inside of a patch;
/// across another (C0) the cloth folds freely. Throws InputError where the garment has other patches, and where a
/// fabric cannot be made of such springs.
SpringNet springNet(const Garment& garment, const SpringNumbers& numbers = {});

/// The second Piola-Kirchhoff resultants (n11, n22, n12) [N/m] of a cell under the Green-Lagrange strain (E11, E22,
/// 2 E12), the derivative of what its springs store under a uniform stretch, over its area; strips that buckle are no
/// part of them.
Vec3 resultantsOf(const SpringCell& cell, const Vec3& strain);
/// The moments (m11, m22, m12) [N] of a cell bent by the curvature (k11, k22, 2 k12) [1/m], likewise of what its
/// flexion springs store over arcs whose chords keep their length. Beyond a right angle between chords, as there.
Vec3 momentsOf(const SpringCell& cell, const Vec3& curvature);

}  // namespace gambeson
