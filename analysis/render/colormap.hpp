#pragma once
/// The colour map of all fields: equal steps of value are equal steps of perceived colour, and lightness alone orders
/// it (it survives a grey print and red-green blindness).

#include <array>

#include "analysis/render/render.hpp"

namespace gambeson {

using ColorTable = std::array<Color, 256>;  ///< sRGB

/// A path in the OKLab space (Ottosson 2020) from dark violet through blue and green to yellow: lightness rises from
/// 0.32 to 0.92 and hue falls from 300 to 105 degrees, each linearly along the path; the chroma stays inside sRGB.
/// Sampled at equal OKLab distances.
ColorTable makeColorTable();

/// The colour at t in [0, 1] (clamped), interpolated linearly in the table.
Color colorAt(const ColorTable& table, double t);

float linearOfSrgb(float s);  ///< IEC 61966-2-1, s in [0, 1]
float srgbOfLinear(float l);

}  // namespace gambeson
