#pragma once
/// How far a NURBS sheet stands out between its samples.

#include <span>

#include "core/cloth/bulge.hpp"
#include "core/cloth/shell/surface.hpp"

namespace gambeson {

/// `surface`: of the garment, with these samples per cell.
Bulges buildBulges(const Garment& garment, const Surface& surface, std::span<const int> per_cell);

}  // namespace gambeson
