#pragma once
/// What a loop leaves of one cell, as pieces of a simple shape with a Gauss rule of positive weights on each.

#include <span>
#include <vector>

#include "core/math/quadrature.hpp"
#include "core/nurbs/trim_arcs.hpp"

namespace gambeson {

/// The points of the kept part of the cell [u0, u1] x [v0, v1]; `arcs` are those of splitAtGrid that lie in it (at
/// least one). `rule` is taken in both directions of every piece.
std::vector<CellPoint> cutCellPoints(const TrimBoundary& boundary, std::span<const MonotoneArc> arcs, double u0,
                                     double u1, double v0, double v1, const Quadrature& rule);

}  // namespace gambeson
