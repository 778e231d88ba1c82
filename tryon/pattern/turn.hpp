#pragma once
/// How sharply a drafted surface turns.

#include <numbers>

#include "core/nurbs/nurbs.hpp"

namespace gambeson {

/// Beyond it a cell counts as folded [rad]: drafts of sleeves that keep below cross nothing, those beyond did (turns of
/// 105 to 173 degrees, with steps of a tenth).
inline constexpr double kFoldedTurn_rad = 95 * std::numbers::pi / 180;

/// The largest angle between two normals of the surface within one of its cells [rad], at 5 x 5 points inside each. Of
/// a smooth drape it is a few degrees; where it nears a half turn the cell is folded, its basis cannot follow, and
/// bending alone sets the step.
double largestTurn(const NurbsPatch& patch);

}  // namespace gambeson
