#pragma once
/// Edges of patches: parameters, derivatives along and into the patch, quadrature.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// Throws InputError (key `key`) unless the patch exists and its knots are clamped: then the edge is a curve of its own
/// row of control points, and the cross derivative there depends on that row and the next alone.
void checkEdge(const Garment& garment, const PatchEdge& edge, const std::string& key);
/// Throws InputError (key `key`) unless the patch exists and uv lies in its parameter range, on what trimming
/// leaves.
void checkPoint(const Garment& garment, int patch, Vec2 uv, const std::string& key);

const KnotVector& alongKnots(const NurbsPatch& patch, Side side);   ///< along the edge
const KnotVector& acrossKnots(const NurbsPatch& patch, Side side);  ///< across it

/// The parameters (u, v) of a point of an edge.
Vec2 edgeParameters(const Garment& garment, const PatchEdge& edge, double t);

/// Basis at a point of an edge: value, derivative along it (in the sense of the edge), and across it into the patch.
/// Columns are control points of the garment; those whose three values vanish are left out.
struct EdgeBasis {
  std::vector<int> columns;
  std::vector<double> value, along, inward;
};
/// `t` is the patch's own parameter along the edge.
EdgeBasis edgeBasis(const Garment& garment, const PatchEdge& edge, double t);

/// The parts of an edge that trimming leaves, as ranges of its parameter, ascending; the whole range without trims.
/// Throws InputError where nothing is left.
std::vector<std::pair<double, double>> keptRanges(const Garment& garment, const PatchEdge& edge);
/// Of each control point of the edge, in the patch's own order: whether its basis function reaches a kept part.
std::vector<bool> keptControls(const Garment& garment, const PatchEdge& edge);

/// A quadrature point of an edge at rest.
struct EdgePoint {
  double t = 0;
  double length_m = 0;  ///< rest length that it stands for
};
/// Gauss points per knot cell of the edge, or what trimming leaves of it; degree + 3 of them where `per_cell` is 0, as
/// arc length is no polynomial. Throws InputError where the edge has no length.
std::vector<EdgePoint> edgePoints(const Garment& garment, const PatchEdge& edge, int per_cell = 0);

/// All control points at rest, patch after patch.
std::vector<Vec3> restControls(const Garment& garment);

}  // namespace gambeson
