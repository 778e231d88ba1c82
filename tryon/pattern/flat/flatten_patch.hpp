#pragma once
/// A patch of a draft laid flat, as a pattern maker does who presses a piece of a fitting on the table.

#include "core/nurbs/nurbs.hpp"

namespace gambeson {

/// By how much a patch had to be strained to lie flat. Principal stretches s of the map from the patch to the plane.
struct Flattening {
  double largest_strain = 0;  ///< max |s - 1|, of triangles
  double rms_strain = 0;      ///< sqrt of the mean over the area of ((s1 - 1)^2 + (s2 - 1)^2) / 2
  double area_change = 0;     ///< flat area over that of the patch, less 1
};

/// Places in the plane of a grid over the parameters of a patch.
struct FlatPatch {
  std::vector<double> u, v;  ///< of the grid's lines, ascending, ends included
  std::vector<Vec2> points;  ///< u fastest [m]
  Flattening flattening;

  const Vec2& at(int i, int j) const { return points[static_cast<std::size_t>(i) + u.size() * j]; }
  /// Bilinear between grid lines.
  Vec2 at(Vec2 uv) const;
};

/// The flat shape nearest to the patch: of the maps to the plane the one with the least
///   E = ∑ A_t |J_t - R_t|^2,   R_t the rotation nearest to J_t
/// (as rigid as possible: Liu et al. 2008, "A local/global approach to mesh parameterization"), by turns of rotations
/// and a linear solve, until no point moves by more than 1e-9 of the patch's size. Triangles have the lengths of
/// geodesics, not of chords: what can be developed comes out with its own lengths, up to the fourth power of the
/// triangles' size. `per_cell` grid lines for each cell of the patch. The grid's middle v line runs upward there, and u
/// to the right: the patch is seen along -(x_u cross x_v).
///
/// Throws InputError (key "flat") where a triangle would lie upside down: the patch can only be laid flat in pieces.
FlatPatch flattenPatch(const NurbsPatch& patch, int per_cell = 4);

}  // namespace gambeson
