#pragma once
/// Noise of a sheet or of a mesh: deviations along its normal that a run or a shape starts from.

#include <vector>

#include "cases/cloth/sheet.hpp"
#include "core/cloth/cloth.hpp"

namespace gambeson {

/// Displacements along the rest normal.
struct NoiseCase {
  double amplitude_m = 0;
  int seed = 1;
  /// 0: each control point by itself, uniform in -amplitude .. amplitude. Else waves `from` to `to` over the range of
  /// u, or of v, with random phases and sizes, the same on all meshes; the largest value is the amplitude.
  int from = 0, to = 0;
  bool along_v = false;
};

/// Displacements of all control points along the rest normal.
std::vector<Vec3> noiseOf(const Sheet& sheet, const NoiseCase& noise);

/// The same of triangles: displacements of the points from `first` to `end` of a cloth, each by itself along the normal
/// of the triangles about it. `surface`: of the cloth, whose samples are its points there.
std::vector<Vec3> noiseOf(const Cloth& cloth, const Surface& surface, int first, int end, const NoiseCase& noise);

}  // namespace gambeson
