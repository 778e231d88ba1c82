#include "core/cloth/degenerated/degenerated_tangent.hpp"

#include <algorithm>

#include "core/cloth/free_blocks.hpp"

namespace gambeson {
namespace {

using Block = std::array<double, 9>;

Block blockOf(const CellStiffness& K, std::size_t k, std::size_t l) {
  Block b;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      b[3 * r + c] = 0.5 * (K[(3 * k + r) * 24 + 3 * l + c] + K[(3 * l + c) * 24 + 3 * k + r]);
  return b;
}
/// B Q, Q w = w x d: each row v of B becomes v . (w x d) = w . (d x v).
Block timesTurn(const Block& b, const Vec3& d) {
  Block out;
  for (std::size_t r = 0; r < 3; ++r) {
    const Vec3 row = cross(d, Vec3{b[3 * r], b[3 * r + 1], b[3 * r + 2]});
    out[3 * r] = row.x, out[3 * r + 1] = row.y, out[3 * r + 2] = row.z;
  }
  return out;
}
Block transposed(const Block& b) { return {b[0], b[3], b[6], b[1], b[4], b[7], b[2], b[5], b[8]}; }

class DegeneratedTangent : public ClothTangent {
 public:
  explicit DegeneratedTangent(const DegeneratedShell& cloth) : cloth_(cloth) {
    std::vector<std::vector<int>> elements;
    for (const ShellCell& cell : cloth.cells()) {
      std::vector<int> rows;
      for (std::size_t k = 0; k < 8; ++k) rows.push_back(rowOf(cell, k));
      std::sort(rows.begin(), rows.end());
      rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
      elements.push_back(std::move(rows));
    }
    sparsity_ = blockSparsity(cloth.map().T.column_count + cloth.innerBlocks(), elements);
  }
  const BlockMatrix& sparsity() const override { return sparsity_; }
  void assemble(const ClothState& state, ClothWork&, BlockMatrix& K, const ForceTerms& terms) const override {
    if (K.columns.size() != sparsity_.columns.size() || K.offsets != sparsity_.offsets) K = sparsity_;
    K.values.assign(9 * K.columns.size(), 0.0);
    CellStiffness own;
    CornerVectors gradient;
    for (const ShellCell& cell : cloth_.cells()) {
      const CornerVectors now = cloth_.cornersOf(cell, state);
      cloth_.kernel().stiffness(cell, now, cloth_.memoryOf(cell, state), terms, own, gradient);
      for (std::size_t k = 0; k < 8; ++k)
        for (std::size_t l = 0; l < 8; ++l) {
          const int r = rowOf(cell, k), c = rowOf(cell, l);
          if (r > c) continue;  // its mirror image comes with k and l exchanged
          Block block = blockOf(own, k, l);
          if (l >= 4) block = timesTurn(block, now[l]);
          if (k >= 4) block = transposed(timesTurn(transposed(block), now[k]));
          if (k == l && k >= 4 && !terms.definite) addOwn(now[k], -dot(gradient[k], now[k]), block);
          K.add(r, c, block);
        }
    }
  }
  void holdIdle(const ClothState& state, BlockMatrix& K) const override {
    for (const ShellCell& cell : cloth_.cells()) {
      const CornerVectors now = cloth_.cornersOf(cell, state);
      for (std::size_t k = 4; k < 8; ++k) {
        Block block{};
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) block[static_cast<std::size_t>(3 * r + c)] = cell.hold_Nm * now[k][r] * now[k][c];
        K.add(rowOf(cell, k), rowOf(cell, k), block);
      }
    }
  }

 private:
  int rowOf(const ShellCell& cell, std::size_t node) const {
    if (node < 4) {
      const SparseRows& T = cloth_.map().T;
      return T.columns[static_cast<std::size_t>(T.offsets[static_cast<std::size_t>(cell.corner[node])])];
    }
    return cloth_.map().T.column_count + cell.director[node - 4];
  }
  /// bend (1 - d dᵀ).
  static void addOwn(const Vec3& d, double bend, Block& block) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) block[static_cast<std::size_t>(3 * r + c)] += bend * ((r == c ? 1 : 0) - d[r] * d[c]);
  }

  const DegeneratedShell& cloth_;
  BlockMatrix sparsity_;
};

}  // namespace

std::unique_ptr<ClothTangent> degeneratedTangent(const DegeneratedShell& cloth) {
  return std::make_unique<DegeneratedTangent>(cloth);
}

}  // namespace gambeson
