#pragma once
/// What a cell of solid yarns answers as a cloth.

#include "core/yarn/cell_response.hpp"
#include "core/yarn/solid_path.hpp"

namespace gambeson {

/// Of an equilibrium: what the faces carry times how they move with the load, by area at rest. Without friction, and as
/// far as augmentations have settled, the derivative of the energy. The energy has that of penalties in it; moment 0.
CellResultants resultantsOf(const SolidCell& cell, const SolidCellState& state);

/// (S11, S22, S12) of what the faces carry: resultants divided by the height of the cell [Pa].
std::array<double, 3> stressOf(const SolidCell& cell, const CellResultants& n);

/// (S11, S22, S12) as Man prints it (2006, eq. 4.58, 4.64): the sum of F⁻¹P over the yarns, divided by area times
/// height [Pa]. Not conjugate to the load where yarns press on each other across voids (4.56 does not hold there).
std::array<double, 3> meanStress(const SolidCell& cell, std::span<const Vec3> x);

}  // namespace gambeson
