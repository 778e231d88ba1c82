#pragma once
/// Flat shapes on an image. Coverage blends the encoded (sRGB) values, as screens and printers expect of text.

#include <algorithm>
#include <cmath>

#include "analysis/render/render.hpp"

namespace gambeson {

inline void blend(Image& image, int x, int y, Color color, float coverage) {
  if (x < 0 || y < 0 || x >= image.width || y >= image.height || !(coverage > 0)) return;
  unsigned char* p = &image.rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                     static_cast<std::size_t>(x))];
  const float c[3] = {color.r, color.g, color.b};
  for (int i = 0; i < 3; ++i)
    p[i] = static_cast<unsigned char>(
        std::lround(std::clamp(float(p[i]) + coverage * (255 * c[i] - float(p[i])), 0.0f, 255.0f)));
}

/// Fills where `inside(x, y)` holds, 4 x 4 samples in each pixel of the box.
template <class Inside>
void fillWhere(Image& image, double left, double top, double right, double bottom, Color color, float opacity,
               Inside inside) {
  for (int y = static_cast<int>(std::floor(top)); y < static_cast<int>(std::ceil(bottom)); ++y)
    for (int x = static_cast<int>(std::floor(left)); x < static_cast<int>(std::ceil(right)); ++x) {
      int hits = 0;
      for (int k = 0; k < 16; ++k) hits += inside(x + (k % 4 + 0.5) / 4, y + (k / 4 + 0.5) / 4) ? 1 : 0;
      blend(image, x, y, color, opacity * float(hits) / 16);
    }
}

/// A rectangle with exact coverage of partial pixels.
inline void fillRect(Image& image, double left, double top, double right, double bottom, Color color,
                     float opacity = 1) {
  for (int y = static_cast<int>(std::floor(top)); y < static_cast<int>(std::ceil(bottom)); ++y)
    for (int x = static_cast<int>(std::floor(left)); x < static_cast<int>(std::ceil(right)); ++x) {
      const double w = std::min(right, x + 1.0) - std::max(left, double(x)),
                   h = std::min(bottom, y + 1.0) - std::max(top, double(y));
      blend(image, x, y, color, opacity * static_cast<float>(std::max(0.0, w) * std::max(0.0, h)));
    }
}

}  // namespace gambeson
