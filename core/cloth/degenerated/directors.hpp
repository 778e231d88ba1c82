#pragma once
/// Directors of the degenerated shell: unit vectors through the thickness, one at each point (Man 2006, eq. 2.38).
///
/// Their rates are spins w [rad/s] in space, three numbers each, of which the one about the director itself turns
/// nothing: there is no drilling. A director goes where a rotation about its spin takes it from where it is,
///   d' = exp(dt w) d,  which is eq. 2.41 with d in the place of the director at rest,
/// so that no angle is special; from the director at rest a half turn would be. A spin normal to d stays normal to d'
/// and has no part about it: d' moves on a great circle.

#include <span>
#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// Patches whose seam is smooth (G1), or whose normals at rest differ by less along the whole of it, share directors
/// there: the seam bends as cloth does. At other seams each side has its own: the seam is a free hinge.
constexpr double kSmoothSeam_rad = 0.2618;  // 15 degrees: where a tube of 8 cells is closed they differ by 11

struct Directors {
  std::vector<Vec3> rest;     ///< unit vectors
  std::vector<int> of_point;  ///< the director of each control point of the garment
};

/// The normals of a patch at its control points, from parabolas through three neighbours along u and v (two where there
/// are no more): of a smooth shape they are good to the second order in the cells' sides, and of the third at ends.
/// Throws InputError (key "patches") where points coincide or the surface has no normal.
std::vector<Vec3> normalsOf(const NurbsPatch& patch);

/// Of a garment of nodes: normals, averaged where they are shared. Throws InputError (key "seams[i]...") where patches
/// meet smoothly but with opposite normals, and where a seam that is a free hinge has a spring.
Directors directorsOf(const Garment& garment);

/// d' = exp(w) d, of length 1 to rounding.
Vec3 turned(const Vec3& director, const Vec3& turn_rad);

}  // namespace gambeson
