#include "analysis/render/colormap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {
namespace {

/// OKLab (L, a, b) to linear sRGB: the cube of a linear map, then a linear map (Ottosson 2020).
Vec3 linearOfOklab(const Vec3& c) {
  const double l = std::pow(c.x + 0.3963377774 * c.y + 0.2158037573 * c.z, 3);
  const double m = std::pow(c.x - 0.1055613458 * c.y - 0.0638541728 * c.z, 3);
  const double s = std::pow(c.x - 0.0894841775 * c.y - 1.2914855480 * c.z, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

/// The path before it is measured. The chroma dips between blue and green, where sRGB holds 0.106 at most (found by
/// bisection along this path), and rises towards yellow.
Vec3 pathAt(double t) {
  const double lightness = 0.32 + 0.60 * t;
  const double hue = (300 - 195 * t) * 3.14159265358979323846 / 180;
  const double chroma = 0.088 + 0.060 * std::pow(1 - t, 4) + 0.090 * t * t * t;
  return {lightness, chroma * std::cos(hue), chroma * std::sin(hue)};
}

}  // namespace

float linearOfSrgb(float s) { return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f); }
float srgbOfLinear(float l) { return l <= 0.0031308f ? 12.92f * l : 1.055f * std::pow(l, 1 / 2.4f) - 0.055f; }

ColorTable makeColorTable() {
  constexpr int fine = 4096;
  std::vector<double> length(fine + 1, 0.0);
  for (int i = 1; i <= fine; ++i)
    length[i] = length[i - 1] + norm(pathAt(double(i) / fine) - pathAt(double(i - 1) / fine));
  ColorTable table;
  int at = 0;
  for (std::size_t k = 0; k < table.size(); ++k) {
    const double wanted = length[fine] * double(k) / double(table.size() - 1);
    while (at < fine - 1 && length[at + 1] < wanted) ++at;
    const double t = (at + (wanted - length[at]) / (length[at + 1] - length[at])) / fine;
    const Vec3 rgb = linearOfOklab(pathAt(t));
    const auto encode = [](double v) { return srgbOfLinear(static_cast<float>(std::clamp(v, 0.0, 1.0))); };
    table[k] = {encode(rgb.x), encode(rgb.y), encode(rgb.z)};
  }
  return table;
}

Color colorAt(const ColorTable& table, double t) {
  const double x = std::clamp(t, 0.0, 1.0) * double(table.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(x), table.size() - 2);
  const float f = static_cast<float>(x - double(i));
  const Color &a = table[i], &b = table[i + 1];
  return {a.r + f * (b.r - a.r), a.g + f * (b.g - a.g), a.b + f * (b.b - a.b)};
}

}  // namespace gambeson
