#pragma once
/// Surface samples: all that contact, pictures and analysis see of a cloth.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/patch_edge.hpp"
#include "core/math/sparse.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// x = W q. Rows of W sum to 1 and W T has full column rank. `area_m2` is consistent: Wᵀ a = ∫ N dA over the free
/// points, so that a uniform pressure p is the impulse a p dt on the samples: the minimum-norm solution; with trimmed
/// patches, where that turns negative beside slivers, the positive one nearest to the areas g that the triangles give
/// to the samples (least sum a log(a/g) - a); where there is none (strips narrower than a cell), samples are added in
/// the middles of triangles until there is.
struct Surface {
  SparseRows W;   ///< samples x control points
  SparseRows WT;  ///< samples x free points, W T
  SparseRows WTt;
  std::vector<double> area_m2;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> triangle_patch;  ///< ascending
  /// i + (size_u - 1) j of its patch's grid; where trimmed that of its centroid; without a grid its number.
  std::vector<int> triangle_cell;
  std::vector<int> patch;        ///< of each sample
  std::vector<Vec2> parameters;  ///< (u, v) of each sample in its patch
  /// Samples of each patch, u fastest; -1 where trimming leaves none; empty where a patch has no grid.
  std::vector<std::vector<int>> patch_grid;
  std::vector<std::array<int, 2>> patch_grid_size;
  /// Of patches that are trimmed or have no grid: the samples on each of their sides (u0, u1, v0, v1 first), ascending
  /// in the parameter; empty of others.
  std::vector<std::vector<std::vector<int>>> edge_samples;
  /// Pairs of samples that lie on or beside each other across a sewn seam (core/cloth/patches/sewn_twins.hpp).
  std::vector<std::array<int, 2>> twins;

  int size() const { return static_cast<int>(area_m2.size()); }
};

/// Places all over a cloth with triangles between them, for pictures, tables and ParaView.
struct PlaceMesh {
  std::vector<int> patch;
  std::vector<Vec2> uv;        ///< parameters
  std::vector<Vec2> fraction;  ///< of the patch's range
  std::vector<std::array<int, 3>> triangles;
};

/// Indices of the points along an edge of a grid of nu x nv, u fastest, in the edge's sense.
std::vector<int> gridEdge(int nu, int nv, const PatchEdge& edge);
/// The samples along an edge, in the edge's sense; of a trimmed patch those on what is left of it.
std::vector<int> edgeSamples(const Surface& surface, const PatchEdge& edge);
/// The samples of the surface's border that lie on a line of places (NamedEdge::lines), in its sense.
std::vector<int> lineSamples(const Surface& surface, std::span<const EdgePlace> line);

}  // namespace gambeson
