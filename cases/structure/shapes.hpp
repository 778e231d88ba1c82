#pragma once
/// Exact patches of simple shapes, at the lowest degree. Internal to sheet.cpp.

#include "cases/structure/sheet.hpp"

namespace gambeson {

/// Of a shape cut into a grid of patches: how many each way, and the angle of a piece where it is an arc (0: straight).
struct Grid {
  int count_u = 1, count_v = 1;
  bool closed_u = false, closed_v = false;
  double angle_u_rad = 0, angle_v_rad = 0;
};

/// How many equal pieces of at most 90 degrees an arc is made of, so that `cells` divide among them; 0 where the cells
/// are too few. Within a piece the curve is one rational span, smooth; larger arcs as one patch would need double
/// knots, where a rotation-free shell has a hinge.
int arcPieces(double angle_rad, int cells);

NurbsPatch platePatch(const PlateShape& s);
/// Piece (i, j) of the grid.
NurbsPatch cylinderPatch(const CylinderShape& s, const Grid& grid, int i);
NurbsPatch spherePatch(const SphereShape& s, const Grid& grid, int i, int j);
NurbsPatch annulusPatch(const AnnulusShape& s, const Grid& grid, int j);

/// Twice the area that a chain of curves runs around, positive counter-clockwise.
double turningArea(const std::vector<NurbsCurve>& loop);

}  // namespace gambeson
