#pragma once
/// Field tables of what a cell is made of.

#include "cases/input/schema.hpp"
#include "cases/yarns/cell_design.hpp"

namespace gambeson::schema {

Object weaveTable();        ///< WeaveCase
Object yarnTable();         ///< YarnCase
Object compressionTable();  ///< LateralCompression
Object cellSolverTable();   ///< CellSolver
Object solidsTable();       ///< SolidsCase

}  // namespace gambeson::schema
