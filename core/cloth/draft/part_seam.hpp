#pragma once
/// Seams that join a whole edge to a part of another (Seam::first_cell), exactly.
///
/// On its cells, edge b is a spline of the space that edge a spans: clamped at the ends of the part, with the same
/// knots between. So each control point of a is an affine combination of those of b, the blossom of b's polynomial
/// pieces at the knots of a (Ramshaw 1989), and the map T holds the two together without a penalty and without a
/// smaller step.

#include <utility>
#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// Knots of an edge mapped to [0, 1] in the edge's sense.
std::vector<double> edgeKnots(const NurbsPatch& patch, const PatchEdge& edge);

/// The part of edge b that a seam joins. rows[k]: control point k of edge a from control points of edge b (numbered
/// along the edge), both in the edges' senses.
struct EdgePart {
  std::vector<std::vector<std::pair<int, double>>> rows;
  double from = 0, to = 1;  ///< of edge b over [0, 1], in its sense
};

/// Throws InputError (key "seams[i]") where edge a does not fit on that part of edge b: another degree, too many cells,
/// other knots, weights that are not equal along the edges, or a seam that is G1.
EdgePart partOf(const Garment& garment, int seam);

}  // namespace gambeson
