#pragma once
/// How the cells of a NURBS sheet are integrated.

namespace gambeson {

/// How quadratic cells are integrated; other degrees, and what trimming leaves of a cell, always take the full rule of
/// degree + 1 points in each direction. Quadratic cells lock in bending under it.
///   automatic: 2 x 2 points; three across a patch of one cell (or of cells that meet in double knots only), where two
///              miss a mode; 3 x 3 on trimmed patches
///   full:      3 x 3 points
///   assumed:   assumed strains (core/cloth/shell/assumed.hpp): free of locking for any thickness, less accurate where
///              membrane stress governs the bending (wrinkles, hanging strips)
enum class CellRule { automatic, full, assumed };

}  // namespace gambeson
