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

/// d(n11, n22, n12)/d(E11, E22, 2 E12) [N/m], symmetric, by rows, of an equilibrium without friction that `method`
/// found: where penalties alone press they give way, else nodes stay on their facets. Throws RunError where a node
/// rubs.
std::array<double, 9> membraneTangent(const SolidCell& cell, const SolidCellState& state, SolidCellWork& work,
                                      SolidContactMethod method = SolidContactMethod::augmented);

/// The strain E22 at which n22 = 0 under the E11 and 2 E12 of the state's load (uniaxial with free sides), to which it
/// moves the state; where the cloth is pulled along the warp, E11 at which n11 = 0. Newton's method with the tangent of
/// what touches, until |n22| is below `tolerance` times |n11| + |n12|, or rounding at rest. With friction: `from`, the
/// last load that was accepted; every trial starts there, so that what is lost does not depend on how the strain was
/// found, and slopes are secants.
SolidLoadReport freeAcross(const SolidCell& cell, SolidCellState& state, SolidCellWork& work, double tolerance = 1e-6,
                           const SolidLoadOptions& options = {}, YarnDirection pulled = along_weft,
                           const SolidCellState* from = nullptr);

}  // namespace gambeson
