#include "cases/cell/yarn_shape.hpp"

#include <cmath>
#include <numbers>

namespace gambeson {
namespace {

constexpr int kAround = 24;  ///< vertices of a section

/// Rings of a tube's sections; the first and the last once more, so that the ends have edges.
int ringsOf(const YarnTube& tube) { return static_cast<int>(tube.sections.size()) + 2; }
/// The section of a ring.
int sectionOf(const YarnTube& tube, int ring) {
  return ring == 0 ? 0 : ring == ringsOf(tube) - 1 ? ring - 2 : ring - 1;
}

}  // namespace

YarnSurface surfaceOf(std::span<const YarnTube> tubes) {
  YarnSurface out;
  for (const YarnTube& tube : tubes) {
    const int first = static_cast<int>(out.direction.size()), rings = ringsOf(tube);
    const auto at = [&](int ring, int k) { return first + ring * kAround + k % kAround; };
    for (int ring = 1; ring + 2 < rings; ++ring)
      for (int k = 0; k < kAround; ++k) {
        out.triangles.push_back({at(ring, k), at(ring, k + 1), at(ring + 1, k + 1)});
        out.triangles.push_back({at(ring, k), at(ring + 1, k + 1), at(ring + 1, k)});
      }
    for (int k = 1; k + 1 < kAround; ++k) {
      out.triangles.push_back({at(0, 0), at(0, k + 1), at(0, k)});
      out.triangles.push_back({at(rings - 1, 0), at(rings - 1, k), at(rings - 1, k + 1)});
    }
    out.direction.insert(out.direction.end(), static_cast<std::size_t>(rings * kAround),
                         static_cast<char>(tube.direction));
  }
  return out;
}

YarnShape shapeOf(std::span<const YarnTube> tubes) {
  YarnShape out;
  for (const YarnTube& tube : tubes)
    for (int ring = 0; ring < ringsOf(tube); ++ring) {
      const auto section = static_cast<std::size_t>(sectionOf(tube, ring));
      for (int k = 0; k < kAround; ++k) {
        const double angle = 2 * std::numbers::pi * k / kAround;
        out.vertices.push_back(tube.sections[section] *
                               Vec3{0, tube.half_width_m * std::cos(angle), tube.half_thickness_m * std::sin(angle)});
        out.stress_Pa.push_back(tube.stress_Pa[section]);
      }
    }
  return out;
}

}  // namespace gambeson
