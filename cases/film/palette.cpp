#include "cases/film/palette.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gambeson {
namespace {

struct Shade {
  double at[3], weight;
  std::size_t cell;
};

struct ShadeBox {
  std::size_t from, to;  ///< of the shades
  double mean[3] = {}, spread = 0;
  int axis = 0;
};

ShadeBox boxed(const std::vector<Shade>& shades, std::size_t from, std::size_t to) {
  ShadeBox box{from, to};
  double weight = 0, sum[3] = {}, squares[3] = {};
  for (std::size_t i = from; i < to; ++i) {
    weight += shades[i].weight;
    for (int c = 0; c < 3; ++c) {
      sum[c] += shades[i].weight * shades[i].at[c];
      squares[c] += shades[i].weight * shades[i].at[c] * shades[i].at[c];
    }
  }
  double widest = -1;
  for (int c = 0; c < 3; ++c) {
    box.mean[c] = sum[c] / weight;
    const double spread = std::max(0.0, squares[c] - sum[c] * box.mean[c]);
    box.spread += spread;
    if (spread > widest) widest = spread, box.axis = c;
  }
  if (to - from < 2) box.spread = 0;
  return box;
}

}  // namespace

void ColorCount::add(const Image& image) {
  for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3) {
    Cell& cell = cells_[cellOf(&image.rgb[i])];
    ++cell.count;
    for (std::size_t c = 0; c < 3; ++c) cell.sum[c] += image.rgb[i + c];
  }
}

Palette paletteOf(const ColorCount& colors) {
  std::vector<Shade> shades;
  for (std::size_t k = 0; k < colors.cells().size(); ++k) {
    const ColorCount::Cell& cell = colors.cells()[k];
    if (cell.count == 0) continue;
    const auto n = static_cast<double>(cell.count);
    shades.push_back({{static_cast<double>(cell.sum[0]) / n, static_cast<double>(cell.sum[1]) / n,
                       static_cast<double>(cell.sum[2]) / n},
                      std::sqrt(n),
                      k});
  }
  Palette palette;
  palette.of_cell.assign(ColorCount::kCells, 0);
  if (shades.empty()) return palette;
  std::vector<ShadeBox> boxes{boxed(shades, 0, shades.size())};
  while (boxes.size() < palette.argb.size() - 1) {
    const auto widest =
        std::max_element(boxes.begin(), boxes.end(), [](const auto& a, const auto& b) { return a.spread < b.spread; });
    if (!(widest->spread > 0)) break;
    const ShadeBox whole = *widest;
    const auto first = shades.begin() + static_cast<std::ptrdiff_t>(whole.from),
               last = shades.begin() + static_cast<std::ptrdiff_t>(whole.to);
    const auto middle =
        std::partition(first, last, [&](const Shade& s) { return s.at[whole.axis] < whole.mean[whole.axis]; });
    if (middle == first || middle == last) {  // they differ by rounding alone
      widest->spread = 0;
      continue;
    }
    const auto cut = static_cast<std::size_t>(middle - shades.begin());
    *widest = boxed(shades, whole.from, cut);
    boxes.push_back(boxed(shades, cut, whole.to));
  }
  for (std::size_t b = 0; b < boxes.size(); ++b) {
    std::uint32_t argb = 255;
    for (const double mean : boxes[b].mean) argb = argb << 8 | static_cast<std::uint32_t>(std::lround(mean));
    palette.argb[b] = argb;
  }
  for (const Shade& s : shades) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < boxes.size(); ++b) {
      double far = 0;
      for (int c = 0; c < 3; ++c) far += (s.at[c] - boxes[b].mean[c]) * (s.at[c] - boxes[b].mean[c]);
      if (far < least) least = far, palette.of_cell[s.cell] = static_cast<unsigned char>(b);
    }
  }
  // Places that are not used are opaque: only the last is to mean "as before".
  for (std::size_t b = boxes.size(); b + 1 < palette.argb.size(); ++b) palette.argb[b] = 0xff000000u;
  return palette;
}

}  // namespace gambeson
