#pragma once
/// Adds the stiffness of an element on control points to a matrix on free points.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/free_map.hpp"
#include "core/math/block_matrix.hpp"

namespace gambeson {

/// K += Tᵀ S T with S = (B + Bᵀ)/2; B is given by 3 x 3 blocks (row by row), blocks[I * n + J] between the control
/// points columns[I] and columns[J]. Every pair of free points of the element is in the sparsity of K.
void addSymmetrised(const FreeMap& map, std::span<const int> columns, std::span<const std::array<double, 9>> blocks,
                    BlockMatrix& K);

/// The sparsity of elements on these points: every pair of free points that share one.
BlockMatrix blockSparsity(const FreeMap& map, const std::vector<std::vector<int>>& elements);
/// The same of elements on these block rows, each once, of `rows`.
BlockMatrix blockSparsity(int rows, const std::vector<std::vector<int>>& elements);
/// The free points that the points of an element hang on, ascending.
std::vector<int> freePointsOf(const FreeMap& map, std::span<const int> points);

}  // namespace gambeson
