#pragma once
/// Seams: the map T from free to all control points, and the points at which rotational springs act.

#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/free_map.hpp"

namespace gambeson {

/// Offsets of the patches in the list of all control points of a garment (one more than there are patches).
std::vector<int> controlOffsets(const Garment& garment);

/// Control points along an edge, in the edge's sense: on the edge, and one column further in.
struct EdgeColumns {
  std::vector<int> edge, inner;  ///< indices in the list of all control points
};
EdgeColumns edgeColumns(const Garment& garment, const PatchEdge& edge);

/// The map from free to all control points. Joined edges are one point, an edge on a part of another is a combination
/// of its points; the middle column of a G1 seam is
///   q_edge = (q_b + c' q_a) / (1 + c'),   Zheng 2013, eq. 2.35,
/// with c' from the rest geometry. The corner control point of a G1 seam where other than two patches (on the border)
/// or four (inside) meet stays free. Throws InputError (key names the seam) where edges do not match, where the rest
/// geometry is not G1 with a constant ratio, or where two seams contradict each other.
FreeMap buildFreeMap(const Garment& garment);

/// One quadrature point of a rotational spring. `t`, `a`, `b` are derivative rows at the point: along the edge, into
/// patch a, into patch b. Energy 1/2 stiffness (theta - theta0)^2 length, theta the angle between the tangents about t.
struct HingePoint {
  std::vector<int> columns;
  std::vector<double> t, a, b;
  double stiffness_length = 0;  ///< stiffness times length [N m / rad]
  double theta0 = 0;            ///< [rad]
};
std::vector<HingePoint> buildHinges(const Garment& garment);

/// The angle of a hinge and, where `gradient` is not null, its derivative with respect to the control points in
/// `columns`.
double hingeAngle(const HingePoint& hinge, std::span<const Vec3> q, std::vector<Vec3>* gradient);

}  // namespace gambeson
