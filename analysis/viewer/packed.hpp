#pragma once
/// Numbers over time, small enough for a page: whole numbers of 16 bits for each frame and vertex, coded by how they
/// change, then deflated (RFC 1950).
///
/// Of frame t, vertex v and component c, all modulo 2^16:
///   d(t, v) = p(t, v) - p(t - 1, v), p(-1) = 0;   e(t, v) = d(t, v) - d(t, parent(v)), d(t, -1) = 0
/// A vertex moves much as its neighbour does, so that e is small where d is not. Stored is 2 e, or -2 e - 1 where e is
/// negative: its lower bytes of all, in the order of component, frame, vertex, then its upper bytes, likewise.

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

struct Codes {
  std::size_t frames = 0, vertices = 0, components = 1;
  std::vector<std::int16_t> of;  ///< of[(frame * vertices + vertex) * components + component]

  /// One frame alone.
  Codes frame(std::size_t number) const;
};

/// Of each vertex the largest number below its own among those that it shares a triangle with; -1 where there is none.
std::vector<int> parentsOf(std::size_t vertices, std::span<const std::array<int, 3>> triangles);

/// Bytes of the codes, and these deflated.
std::string coded(const Codes& codes, std::span<const int> parents);
std::string packed(const Codes& codes, std::span<const int> parents);

/// RFC 1950. Throws RunError where there is no memory.
std::string deflated(std::string_view bytes);

/// Positions as whole numbers of a quantum q about an origin of each frame, each rounded for itself: errors do not add.
/// q is kQuantum_m, or more where 16 bits do not reach: largest coordinate / 32767.
///   |x - origin - q p| <= sqrt(3) q / 2: 0.087 mm within 3.27 m about the origin
struct PackedPositions {
  static constexpr double kQuantum_m = 1e-4;
  double quantum_m = kQuantum_m;
  double error_m = 0;  ///< the largest distance of a vertex from where it was
  Codes codes;
};
/// `at`: three numbers a vertex, of each frame.
PackedPositions packedPositions(std::span<const std::vector<float>> at, std::span<const Vec3> origin);

/// Values v as p = round(asinh(v / s) / kStep), s = the largest |v| / 1000; -32768 where there is none (not finite).
///   |error| <= kStep / 2 sqrt(v^2 + s^2): 0.2 % of a value above s, and 2e-6 of the largest below it
struct PackedValues {
  static constexpr double kStep = 0.004;
  static constexpr std::int16_t kNone = -32768;
  double scale = 1;  ///< s
  Codes codes;
  double value(std::int16_t code) const;  ///< NaN where there is none
};
PackedValues packedValues(std::span<const std::vector<float>> values);

}  // namespace gambeson
