#include "core/cloth/spring_stiffness.hpp"

#include <algorithm>

#include "core/cloth/free_blocks.hpp"

namespace gambeson {

void addSpringStiffness(const FreeMap& map, const std::array<int, 2>& corner, const Vec3& way,
                        const SpringAnswer<double>& answer, bool definite, BlockMatrix& K) {
  const Vec3 u = normalized(way);
  const double across = definite ? std::max(answer.across, 0.0) : answer.across;
  std::array<std::array<double, 9>, 4> blocks;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double k = (i == j ? across : 0) + (answer.along - across) * u[i] * u[j];
      const auto e = static_cast<std::size_t>(3 * i + j);
      blocks[0][e] = blocks[3][e] = k;
      blocks[1][e] = blocks[2][e] = -k;
    }
  addSymmetrised(map, corner, blocks, K);
}

}  // namespace gambeson
