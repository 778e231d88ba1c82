#include "analysis/viewer/packed.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace gambeson {

std::vector<int> parentsOf(std::size_t vertices, std::span<const std::array<int, 3>> triangles) {
  std::vector<int> parents(vertices, -1);
  for (const std::array<int, 3>& t : triangles)
    for (const int v : t)
      for (const int w : t)
        if (w < v) parents[static_cast<std::size_t>(v)] = std::max(parents[static_cast<std::size_t>(v)], w);
  return parents;
}

Codes Codes::frame(std::size_t number) const {
  const auto begin = of.begin() + static_cast<std::ptrdiff_t>(number * vertices * components);
  return {1, vertices, components, {begin, begin + static_cast<std::ptrdiff_t>(vertices * components)}};
}

std::string coded(const Codes& codes, std::span<const int> parents) {
  const std::size_t count = codes.frames * codes.vertices * codes.components;
  std::string bytes(2 * count, '\0');
  std::vector<std::uint16_t> change(codes.vertices);
  std::size_t at = 0;
  for (std::size_t c = 0; c < codes.components; ++c)
    for (std::size_t t = 0; t < codes.frames; ++t)
      for (std::size_t v = 0; v < codes.vertices; ++v, ++at) {
        const std::size_t i = (t * codes.vertices + v) * codes.components + c;
        const auto now = static_cast<std::uint16_t>(codes.of[i]);
        const auto before =
            t > 0 ? static_cast<std::uint16_t>(codes.of[i - codes.vertices * codes.components]) : std::uint16_t{0};
        change[v] = static_cast<std::uint16_t>(now - before);
        const int parent = parents[v];
        const auto e = static_cast<std::uint16_t>(
            change[v] - (parent >= 0 ? change[static_cast<std::size_t>(parent)] : std::uint16_t{0}));
        const auto z = static_cast<std::uint16_t>((e << 1) ^ (e & 0x8000 ? 0xffff : 0));
        bytes[at] = static_cast<char>(z & 0xff);
        bytes[count + at] = static_cast<char>(z >> 8);
      }
  return bytes;
}

std::string packed(const Codes& codes, std::span<const int> parents) { return deflated(coded(codes, parents)); }

std::string deflated(std::string_view bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::string out(size, '\0');
  const int status = compress2(reinterpret_cast<Bytef*>(out.data()), &size,
                               reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()), 6);
  if (status != Z_OK) throw RunError("the data of the viewer could not be compressed: no memory");
  out.resize(size);
  return out;
}

PackedPositions packedPositions(std::span<const std::vector<float>> at, std::span<const Vec3> origin) {
  PackedPositions out;
  out.codes.frames = at.size();
  out.codes.vertices = at.empty() ? 0 : at[0].size() / 3;
  out.codes.components = 3;
  const auto about = [&](std::size_t t, std::size_t i) {
    return static_cast<double>(at[t][i]) - origin[t][static_cast<int>(i % 3)];
  };
  double largest = 0;
  for (std::size_t t = 0; t < at.size(); ++t)
    for (std::size_t i = 0; i < at[t].size(); ++i) largest = std::max(largest, std::abs(about(t, i)));
  constexpr double most = std::numeric_limits<std::int16_t>::max();
  out.quantum_m = std::max(PackedPositions::kQuantum_m, largest / most);
  out.codes.of.reserve(at.size() * out.codes.vertices * 3);
  double worst2_m2 = 0;
  for (std::size_t t = 0; t < at.size(); ++t) {
    double error2_m2 = 0;
    for (std::size_t i = 0; i < at[t].size(); ++i) {
      const double code = std::round(about(t, i) / out.quantum_m), error = about(t, i) - out.quantum_m * code;
      out.codes.of.push_back(static_cast<std::int16_t>(code));
      error2_m2 = (i % 3 == 0 ? 0 : error2_m2) + error * error;
      worst2_m2 = std::max(worst2_m2, error2_m2);
    }
  }
  out.error_m = std::sqrt(worst2_m2);
  return out;
}

double PackedValues::value(std::int16_t code) const {
  return code == kNone ? std::numeric_limits<double>::quiet_NaN() : scale * std::sinh(kStep * code);
}

PackedValues packedValues(std::span<const std::vector<float>> values) {
  PackedValues out;
  out.codes.frames = values.size();
  out.codes.vertices = values.empty() ? 0 : values[0].size();
  double largest = 0;
  for (const auto& frame : values)
    for (const float v : frame)
      if (std::isfinite(v)) largest = std::max(largest, std::abs(static_cast<double>(v)));
  out.scale = largest > 0 ? 1e-3 * largest : 1;
  out.codes.of.reserve(out.codes.frames * out.codes.vertices);
  for (const auto& frame : values)
    for (const float v : frame)
      out.codes.of.push_back(
          std::isfinite(v) ? static_cast<std::int16_t>(std::lround(std::asinh(v / out.scale) / PackedValues::kStep))
                           : PackedValues::kNone);
  return out;
}

}  // namespace gambeson
