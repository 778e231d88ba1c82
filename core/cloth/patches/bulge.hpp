#pragma once
/// How far cloth on patches stands out between its samples.

#include <span>

#include "core/cloth/bulge.hpp"
#include "core/cloth/patches/surface.hpp"

namespace gambeson {

/// `surface`: of the garment, with these samples per cell.
Bulges buildBulges(const Garment& garment, const Surface& surface, std::span<const int> per_cell);

}  // namespace gambeson
