#pragma once
/// Surface samples: all that contact, pictures and analysis see of a cloth.

#include <array>
#include <vector>

#include "core/math/sparse.hpp"
#include "core/sheet/garment.hpp"
#include "core/sheet/seams.hpp"

namespace gambeson {

/// x = W q. Rows of W sum to 1 and W T has full column rank. `area_m2` is consistent: Wᵀ a = ∫ N dA over the free
/// points, the minimum-norm solution, so that a uniform pressure p is the impulse a p dt on the samples.
struct Surface {
  SparseRows W;   ///< samples x control points
  SparseRows WT;  ///< samples x free points, W T
  SparseRows WTt;
  std::vector<double> area_m2;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> patch;                    ///< of each sample
  std::vector<Vec2> parameters;              ///< (u, v) of each sample in its patch
  std::vector<std::vector<int>> patch_grid;  ///< samples of each patch, u fastest
  std::vector<std::array<int, 2>> patch_grid_size;

  int size() const { return static_cast<int>(area_m2.size()); }
};

/// `per_cell` samples along each cell edge (their parameters divide the cell evenly), or the Greville points for 0.
/// Samples on joined edges are one. Throws InputError where the samples are too few to see every control point, or an
/// area is not positive.
Surface buildSurface(const Garment& garment, const FreeMap& map, int per_cell);

/// ∫ N dA at rest for each control point [m^2].
std::vector<double> controlAreas(const Garment& garment);

/// The samples along an edge, in the edge's sense.
std::vector<int> edgeSamples(const Surface& surface, const PatchEdge& edge);

}  // namespace gambeson
