#pragma once
/// The 255 colours that a film as GIF is drawn with, made once of all its pictures: a colour that stays in the film
/// stays in the file.

#include <array>
#include <cstdint>
#include <vector>

#include "analysis/render/render.hpp"

namespace gambeson {

/// What colours pictures have, in cells of 4 x 4 x 4 values of red, green and blue.
class ColorCount {
 public:
  ColorCount() : cells_(kCells) {}
  void add(const Image& image);

  static constexpr std::size_t kCells = 64 * 64 * 64;
  static std::size_t cellOf(const unsigned char* rgb) {
    return (static_cast<std::size_t>(rgb[0] >> 2) << 12) | (static_cast<std::size_t>(rgb[1] >> 2) << 6) |
           static_cast<std::size_t>(rgb[2] >> 2);
  }
  struct Cell {
    std::uint64_t count = 0, sum[3] = {};
  };
  const std::vector<Cell>& cells() const { return cells_; }

 private:
  std::vector<Cell> cells_;
};

struct Palette {
  std::array<std::uint32_t, 256> argb{};  ///< the last is transparent: encoders say with it that a pixel stays
  std::vector<unsigned char> of_cell;     ///< the nearest colour of each cell that was counted
};

/// Boxes of colours are halved at their mean, along the axis of their largest variance, the box with the largest sum of
/// squared distances first, as Wu 1992 does; a colour weighs by the square root of how often it is there, so that small
/// things such as texts and legends keep theirs.
Palette paletteOf(const ColorCount& colors);

}  // namespace gambeson
