#pragma once
/// The surface samples of cloth on patches.

#include <span>
#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/surface.hpp"

namespace gambeson {

/// Takes `per_cell` samples along each cell edge (their parameters divide the cell evenly), or the Greville points for
/// 0. Samples on joined edges are one, so patches that seams join need the same number. Trimmed patches have samples
/// along their loops, which outline the triangles (trim_mesh.hpp), and within triangles where positive areas need them.
/// Throws InputError where the samples are too few to see every control point, or an area is not positive.
Surface buildSurface(const Garment& garment, const FreeMap& map, int per_cell);
/// The same surface with a number of samples for each patch.
Surface buildSurface(const Garment& garment, const FreeMap& map, std::span<const int> per_cell);

/// The parameters of the samples along one direction of a patch, as buildSurface takes them.
std::vector<double> sampleParameters(const KnotVector& knots, int per_cell);

}  // namespace gambeson
