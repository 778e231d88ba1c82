#pragma once
/// What a cell's case describes, as the core computes it. Of a case that was read.

#include "cases/yarns/cell_design.hpp"
#include "core/yarn/cell_equilibrium.hpp"
#include "core/yarn/kawabata.hpp"
#include "core/yarn/rod_cell.hpp"
#include "core/yarn/solid_path.hpp"

namespace gambeson {

/// Throws InputError as twillWeave, satinWeave and weaveOf.
Weave weaveOf(const WeaveCase& weave);
RodSection sectionOf(const YarnCase& yarn);
WovenYarns wovenYarns(const CellDesign& c);

/// Of yarns that are rods; where the case gives no stiffness to what sticks it is P/(b1 + b2)³, about that of lateral
/// compression at half thickness.
RodFriction rodFriction(const CellDesign& c);
/// The cell of rods, whatever `yarns` says.
RodCellDesign rodDesign(const CellDesign& c);
EquilibriumOptions equilibriumOptions(const CellSolver& solver);

/// Throws InputError, keys under "weft" and "warp", where a yarn is no solid or its moduli are of no stable material.
SolidCellDesign solidDesign(const CellDesign& c);
SolidLoadOptions solidOptions(const CellDesign& c);

/// The truss whose crossings stand where those of the cell do.
KawabataCloth trussOf(const CellDesign& c);

}  // namespace gambeson
