#pragma once
/// Trimmed patches (Zheng 2013, section 2.4): closed loops in the parameter plane, and the cells that they cut.

#include <vector>

#include "core/nurbs/curve.hpp"

namespace gambeson {

/// A closed chain of curves, each starting where the last one ends. Counter-clockwise (in u, v): the inside is kept;
/// clockwise: the inside is a hole.
using TrimLoop = std::vector<NurbsCurve>;

/// What is cut out of a patch. With no counter-clockwise loop the patch's own rectangle is the outline.
struct Trim {
  std::vector<TrimLoop> loops;
  /// Gauss points per direction on the pieces of cut cells; 0: degree + 1 of the patch.
  int points_per_piece = 0;
  /// A control point whose area inside, ∫ N dA over the kept part (eq. 2.37), is below this fraction of that over the
  /// whole patch is not free: it follows its neighbours through the map T. The thesis takes 1e-6 of the cell size, at
  /// which the explicit step of a quadratic sheet falls to 0.18 of the untrimmed one (bending, worst over shifts of a
  /// diamond through a cell); 0.001 leaves 0.30, 0.01 the whole step for degrees 2 and 3, membrane and bending.
  double unused_fraction = 0.01;
};

/// A quadrature point in the parameters; the weight is an area in (u, v).
struct CellPoint {
  double u = 0, v = 0, weight = 0;
};

enum class CellKind { inside, cut, outside };
struct TrimmedCell {
  CellKind kind = CellKind::inside;
  std::vector<CellPoint> points;  ///< of a cut cell; empty otherwise
};

/// The cells of a patch (between breakpoints; u fastest). Cut cells are split into pieces with curved edges that follow
/// the loop itself, so that areas converge at the order of the quadrature.
/// Throws InputError where a loop is open, leaves the patch, crosses itself or another, or nothing is left.
std::vector<TrimmedCell> trimCells(const NurbsPatch& patch, const Trim& trim);

/// Whether a parameter point is kept (on the loop: kept).
bool isKept(const NurbsPatch& patch, const Trim& trim, Vec2 uv);

/// Where the loops meet the lines of breakpoints (the patch's border among them), loop by loop in their order.
std::vector<Vec2> trimIntersections(const NurbsPatch& patch, const Trim& trim);

}  // namespace gambeson
