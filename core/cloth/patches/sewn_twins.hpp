#pragma once
/// Samples that sewn seams bring together.

#include <array>
#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/surface.hpp"

namespace gambeson {

/// Of all seams that are not open, pairs of samples of their two sides: at one fraction of length s, or, where one side
/// has none there, the two of it on both sides of s. So every point of the one border lies, but for what chords differ
/// by, on an edge between twins of the other. Where seams end in one place, samples there are twins through others too.
/// Samples lie on a seam within a tenth of their spacing. `samples`: those of the garment, without `twins`.
std::vector<std::array<int, 2>> sewnTwins(const Garment& garment, const Surface& samples);

}  // namespace gambeson
