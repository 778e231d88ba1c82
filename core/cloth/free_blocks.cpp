#include "core/cloth/free_blocks.hpp"

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

}  // namespace gambeson
