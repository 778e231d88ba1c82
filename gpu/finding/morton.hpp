#pragma once
/// Places along a curve that fills space: 24 bits of Morton's order. Sorting takes a pass less than of 30, and trees
/// are as good.

#include <algorithm>
#include <cstdint>

#include "gpu/finding/float_box.hpp"

namespace gambeson::gpu {

constexpr int kMortonBits = 24;

/// Two zeros between any two of the lowest ten bits.
GAMBESON_HD inline std::uint32_t spread(std::uint32_t v) {
  v = (v * 0x00010001u) & 0xFF0000FFu;
  v = (v * 0x00000101u) & 0x0F00F00Fu;
  v = (v * 0x00000011u) & 0xC30C30C3u;
  return (v * 0x00000005u) & 0x49249249u;
}

/// The cube that is cut into 256^3 cells. What lies outside counts to the cells at its sides: a tree is as right as
/// ever then, only less good.
struct MortonCube {
  float lo[3];
  float cells_per_m;

  /// Of the centre of a box.
  GAMBESON_HD std::uint32_t code(const FloatBox& box) const {
    std::uint32_t cell[3];
    for (int k = 0; k < 3; ++k) {
      const float at = (0.5f * (box.lo[k] + box.hi[k]) - lo[k]) * cells_per_m;
      cell[k] = static_cast<std::uint32_t>(std::min(std::max(at, 0.0f), 255.0f));
    }
    return 4 * spread(cell[0]) + 2 * spread(cell[1]) + spread(cell[2]);
  }
};

}  // namespace gambeson::gpu
