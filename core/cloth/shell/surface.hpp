#pragma once
/// Surface samples: all that contact, pictures and analysis see of a cloth.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/shell/garment.hpp"
#include "core/cloth/shell/seams.hpp"
#include "core/math/sparse.hpp"

namespace gambeson {

/// x = W q. Rows of W sum to 1 and W T has full column rank. `area_m2` is consistent: Wᵀ a = ∫ N dA over the free
/// points, so that a uniform pressure p is the impulse a p dt on the samples: the minimum-norm solution; with trimmed
/// patches, where that turns negative beside slivers, the positive one nearest to the areas g that the triangles give
/// to the samples (least sum a log(a/g) - a).
struct Surface {
  SparseRows W;   ///< samples x control points
  SparseRows WT;  ///< samples x free points, W T
  SparseRows WTt;
  std::vector<double> area_m2;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> triangle_patch;  ///< ascending
  std::vector<int> triangle_cell;   ///< i + (size_u - 1) j of its patch's grid; where trimmed that of its centroid
  std::vector<int> patch;           ///< of each sample
  std::vector<Vec2> parameters;     ///< (u, v) of each sample in its patch
  std::vector<std::vector<int>> patch_grid;  ///< samples of each patch, u fastest; -1 where trimming leaves none
  std::vector<std::array<int, 2>> patch_grid_size;
  /// Of each trimmed patch: the samples on its sides u0, u1, v0, v1, ascending in the parameter; empty of others.
  std::vector<std::vector<std::vector<int>>> edge_samples;

  int size() const { return static_cast<int>(area_m2.size()); }
};

/// `per_cell` samples along each cell edge (their parameters divide the cell evenly), or the Greville points for 0.
/// Samples on joined edges are one, so patches that seams join need the same number. Trimmed patches have samples along
/// their loops, which outline the triangles (trim_mesh.hpp). Throws InputError where the samples are too few to see
/// every control point, or an area is not positive.
Surface buildSurface(const Garment& garment, const FreeMap& map, int per_cell);
/// With a number for each patch.
Surface buildSurface(const Garment& garment, const FreeMap& map, std::span<const int> per_cell);

/// Along one direction of a patch, as buildSurface takes them.
std::vector<double> sampleParameters(const KnotVector& knots, int per_cell);

/// ∫ N dA at rest for each control point [m^2].
std::vector<double> controlAreas(const Garment& garment);
/// ∫ rho N dA with the surface density of each point [kg].
std::vector<double> controlMasses(const Garment& garment);

/// The samples along an edge, in the edge's sense; of a trimmed patch those on what is left of it.
std::vector<int> edgeSamples(const Surface& surface, const PatchEdge& edge);

}  // namespace gambeson
