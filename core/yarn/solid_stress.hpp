#pragma once
/// What solid yarns carry in them and press with on each other, for tables and pictures.

#include "core/yarn/solid_path.hpp"

namespace gambeson {

/// (S11, S22, S12) as Man prints it (2006, eq. 4.58, 4.64): the sum of F⁻¹P over the yarns, divided by area times
/// height [Pa]. Not conjugate to the load where yarns press on each other across voids (4.56 does not hold there).
std::array<double, 3> meanStress(const SolidCell& cell, std::span<const Vec3> x);

/// Cauchy's stress along the fibres at each node [Pa], a . sigma a = A . C S C A/(J I4), a the fibre where it is now:
/// from the Gauss points of a hexahedron to its corners by the trilinear field through them, and the mean of the
/// hexahedra of a node.
std::vector<double> fibreStress(const SolidCell& cell, std::span<const Vec3> x);

/// The largest tension of the yarns of each direction [N]: in every layer of hexahedra along a yarn the sum of
/// V A . S C A/sqrt(I4), the force along the fibres by area at rest, over the layer's length along the yarn's middle.
std::array<double, 2> largestTension(const SolidCell& cell, std::span<const Vec3> x);

/// Of what presses at each node of either yarn [Pa]: normal forces, those on facets shared out to their corners by
/// N_I, over the area of the skin around the node at rest.
std::vector<double> nodePressure(const SolidCell& cell, const SolidCellState& state);

}  // namespace gambeson
