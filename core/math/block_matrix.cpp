#include "core/math/block_matrix.hpp"

#include <algorithm>
#include <cassert>

namespace gambeson {

long BlockMatrix::find(int r, int c) const {
  assert(0 <= r && r <= c && r < rows());
  const auto begin = columns.begin() + offsets[r], end = columns.begin() + offsets[r + 1];
  const auto at = std::lower_bound(begin, end, c);
  return at != end && *at == c ? at - columns.begin() : -1;
}

void BlockMatrix::add(int r, int c, const std::array<double, 9>& block) {
  const bool transposed = r > c;
  const long k = transposed ? find(c, r) : find(r, c);
  assert(k >= 0);
  double* out = &values[9 * k];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) out[3 * i + j] += transposed ? block[3 * j + i] : block[3 * i + j];
}

}  // namespace gambeson
