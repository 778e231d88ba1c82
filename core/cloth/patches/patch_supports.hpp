#pragma once
/// Supports of cloth on patches as linear constraints: easy to state, exact for a rotation-free shell.
///
/// All act on control points, so each holds for the whole edge and not only at some of its points. Common supports:
///   hinged edge       supportEdge, three directions: held, free to turn about itself
///   clamped edge      supportEdge, three directions, and clampRotation
///   diaphragm         supportEdge with the directions in its plane: it stays round, and is free along the axis
///   roller            supportEdge or supportPoint with one direction
///   rigid guide       tieEdge for each direction in which all points move alike; with all three the edge only shifts
/// A clamp that turns by a finite angle, and a bar that keeps its length while it turns, are not linear in the
/// displacements and cannot be stated here. Constraints that several supports share (at a corner, say) are dropped by
/// buildDofMap where they agree. Of a trimmed edge, the control points are held whose basis functions reach what is
/// left of it.

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/mounting.hpp"

namespace gambeson {

/// Holds (or moves) the components of an edge along `directions` (unit vectors; three orthogonal ones hold it whole).
/// Exact at every point of the edge, as the basis sums to 1.
std::vector<LinearConstraint> supportEdge(const Garment& garment, const PatchEdge& edge,
                                          std::span<const Vec3> directions, const Prescribed& motion = {});
/// Holds (or moves) a point of a patch along directions; at a corner that is one control point, elsewhere a
/// combination.
std::vector<LinearConstraint> supportPoint(const Garment& garment, int patch, Vec2 uv, std::span<const Vec3> directions,
                                           const Prescribed& motion = {});
/// No rotation of the sheet about the edge. With t along the edge, x,c the derivative across it and
/// k = (X,c . X,t)/|X,t|^2, the vector s = x,c - k x,t is at rest normal to the edge and to the rest normal n; then
///   n . (u,c - k u,t) = 0
/// says that the sheet has not turned about the edge. That is exact for loads of any size as long as n . x,t = 0 stays
/// true: an edge that is held, slides along itself or in the tangent plane, or shifts as a whole. Where the edge itself
/// tilts out of its rest tangent plane it is the linearised condition. Stretch and shear of s stay free: the membrane
/// is not held.
/// Where n does not turn along the edge the condition holds at every point; otherwise at as many points as the edge has
/// control points (its Greville points; between them the angle is an interpolation error of the order of the basis).
std::vector<LinearConstraint> clampRotation(const Garment& garment, const PatchEdge& edge);
/// Mirror symmetry about the plane through the edge with unit normal n: the edge stays in the plane, and the row next
/// to it moves with it within the plane. A mirrored motion has a deformation gradient that maps n to a multiple of
/// itself, so with k as above the part of u,c - k u,t within the plane is zero: both equations are linear and exact for
/// motions of any size, and shear along the plane vanishes too, as it must.
/// Throws InputError unless the edge lies in such a plane (1e-6 of its length) and the rest surface meets it at right
/// angles (1e-4 rad).
std::vector<LinearConstraint> symmetryEdge(const Garment& garment, const PatchEdge& edge, const Vec3& normal);
/// All points of the edge move alike along `direction` (a rigid bar that carries the edge's load, say).
std::vector<LinearConstraint> tieEdge(const Garment& garment, const PatchEdge& edge, const Vec3& direction);

}  // namespace gambeson
