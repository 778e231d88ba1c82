#pragma once
/// What a cell of yarns answers as a cloth.

#include <array>

#include "core/yarn/cell_equilibrium.hpp"

namespace gambeson {

/// Of one load, by area of the cell at rest. Conjugate to the load by construction: what the faces carry times how they
/// move with it, which in equilibrium is the derivative of the energy. (The mean of the stress of the yarns, Man 2006,
/// eq. 4.64, is not: yarns that press on each other do so across voids.)
struct CellResultants {
  double energy_J_per_m2 = 0;  ///< W
  double n11 = 0, n22 = 0;     ///< dW/dE11, dW/dE22: second Piola-Kirchhoff [N/m]
  double n12 = 0;              ///< dW/d(2 E12) [N/m]
  double moment_N = 0;         ///< dW/dk [N]
};

/// Of an equilibrium. Divided by a thickness n11 is a stress. `history`: of friction, of the last accepted load; W then
/// holds the potential of friction since, and the resultants are its derivatives while pairs stick.
CellResultants resultantsOf(const RodCell& cell, const CellLoad& load, std::span<const Pose> sections,
                            const CellHistory* history = nullptr);

/// d(n11, n22, n12)/d(E11, E22, 2 E12) [N/m] of a flat equilibrium, symmetric, by rows; the sections follow the load.
/// With friction the forces that press are held. Throws RunError where the cell is not stable, or where the load has a
/// curvature.
std::array<double, 9> membraneTangent(const RodCell& cell, const CellLoad& load, std::span<const Pose> sections,
                                      EquilibriumWork& work);

/// The strain E22 at which n22 = 0 under the E11 and 2 E12 of `load` (uniaxial with free sides), from an equilibrium
/// under `load`, which it moves there: Newton's method, until |n22| is below `tolerance` times |n11| + |n12|, or below
/// that of E22's last change. Where the cloth is pulled along the warp, E11 at which n11 = 0. Returns how it ended;
/// `load` and `sections` are of the last equilibrium.
LoadReport freeAcross(const RodCell& cell, CellLoad& load, std::vector<Pose>& sections, EquilibriumWork& work,
                      double tolerance = 1e-6, const EquilibriumOptions& options = {},
                      YarnDirection pulled = along_weft);

}  // namespace gambeson
