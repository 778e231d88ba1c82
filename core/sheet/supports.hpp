#pragma once
/// Supports of a sheet as linear constraints: easy to state, exact for a rotation-free shell.

#include <optional>

#include "core/sheet/constraint.hpp"

namespace gambeson {

/// A motion that a support prescribes: displacement at program value 1 [m].
struct Prescribed {
  Vec3 displacement_m;
  int program = -1;
};

/// Holds (or moves) the components of an edge along `directions` (unit vectors; three orthogonal ones hold it whole).
std::vector<LinearConstraint> supportEdge(const Garment& garment, const PatchEdge& edge,
                                          std::span<const Vec3> directions, const Prescribed& motion = {});
/// Holds (or moves) a point of a patch along directions; at a corner that is one control point, elsewhere a
/// combination.
std::vector<LinearConstraint> supportPoint(const Garment& garment, int patch, Vec2 uv, std::span<const Vec3> directions,
                                           const Prescribed& motion = {});
/// No rotation of the sheet about the edge: the row next to the edge keeps its offset from it, along the rest normal.
/// For linear and nonlinear analysis alike where the edge itself is held or slides along itself (a clamp).
std::vector<LinearConstraint> clampRotation(const Garment& garment, const PatchEdge& edge);
/// Mirror symmetry about the plane through the edge with unit normal n: the edge stays in the plane, and the row next
/// to it moves with it within the plane. Throws InputError unless the edge lies in such a plane and the rest surface
/// meets it at right angles.
std::vector<LinearConstraint> symmetryEdge(const Garment& garment, const PatchEdge& edge, const Vec3& normal);
/// All points of the edge move alike along `direction` (a rigid bar that carries the edge's load, say).
std::vector<LinearConstraint> tieEdge(const Garment& garment, const PatchEdge& edge, const Vec3& direction);

}  // namespace gambeson
