#pragma once
/// The surface of a cell's yarns, as pictures and recordings see it.

#include <array>
#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// What stays while yarns move.
struct YarnSurface {
  std::vector<std::array<int, 3>> triangles;
  std::vector<char> direction;  ///< YarnDirection of each vertex
};

/// Where it is.
struct YarnShape {
  std::vector<Vec3> vertices;
  std::vector<double> stress_Pa;      ///< along the yarn, at each vertex
  std::vector<double> pressure_Pa{};  ///< of other yarns on it, at each vertex; empty where the engine does not know
};

/// A yarn as a tube of elliptical section, closed at both ends.
struct YarnTube {
  int direction = 0;              ///< YarnDirection
  std::vector<Pose> sections;     ///< columns: along the yarn, across it, through the cloth
  std::vector<double> stress_Pa;  ///< at each section
  double half_width_m = 0, half_thickness_m = 0;
};

YarnSurface surfaceOf(std::span<const YarnTube> tubes);
YarnShape shapeOf(std::span<const YarnTube> tubes);

}  // namespace gambeson
