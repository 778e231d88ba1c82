#include "core/cloth/free_blocks.hpp"

#include <algorithm>

#include <cassert>

namespace gambeson {

void addSymmetrised(const FreeMap& map, std::span<const int> columns, std::span<const std::array<double, 9>> blocks,
                    BlockMatrix& K) {
  const std::size_t n = columns.size();
  assert(blocks.size() == n * n);
  const SparseRows& T = map.T;
  for (std::size_t I = 0; I < n; ++I)
    for (std::size_t J = 0; J < n; ++J) {
      std::array<double, 9> s;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) s[3 * i + j] = 0.5 * (blocks[I * n + J][3 * i + j] + blocks[J * n + I][3 * j + i]);
      for (int a = T.offsets[columns[I]]; a < T.offsets[columns[I] + 1]; ++a)
        for (int b = T.offsets[columns[J]]; b < T.offsets[columns[J] + 1]; ++b) {
          const int r = T.columns[a], c = T.columns[b];
          if (r > c) continue;  // its mirror image comes with I and J exchanged
          const long at = K.find(r, c);
          assert(at >= 0);
          double* out = &K.values[9 * at];
          const double w = T.values[a] * T.values[b];
          for (int k = 0; k < 9; ++k) out[k] += w * s[k];
        }
    }
}

std::vector<int> freePointsOf(const FreeMap& map, std::span<const int> nodes) {
  std::vector<int> points;
  for (int node : nodes)
    for (int e = map.T.offsets[node]; e < map.T.offsets[node + 1]; ++e) points.push_back(map.T.columns[e]);
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

BlockMatrix blockSparsity(const FreeMap& map, const std::vector<std::vector<int>>& elements) {
  std::vector<std::vector<int>> free;
  for (const std::vector<int>& nodes : elements) free.push_back(freePointsOf(map, nodes));
  return blockSparsity(map.T.column_count, free);
}

BlockMatrix blockSparsity(int row_count, const std::vector<std::vector<int>>& elements) {
  std::vector<std::vector<int>> rows(static_cast<std::size_t>(row_count));
  for (int r = 0; r < row_count; ++r) rows[r].push_back(r);
  for (std::vector<int> points : elements) {
    std::sort(points.begin(), points.end());
    for (std::size_t i = 0; i < points.size(); ++i)
      rows[points[i]].insert(rows[points[i]].end(), points.begin() + static_cast<long>(i) + 1, points.end());
  }
  BlockMatrix K;
  for (std::vector<int>& row : rows) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    K.columns.insert(K.columns.end(), row.begin(), row.end());
    K.offsets.push_back(static_cast<long>(K.columns.size()));
  }
  K.values.assign(9 * K.columns.size(), 0.0);
  return K;
}

}  // namespace gambeson
