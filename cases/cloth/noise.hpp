#pragma once
/// Noise of a sheet: deviations along its normal that a run or a shape starts from.

#include <vector>

#include "cases/cloth/sheet.hpp"

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

}  // namespace gambeson
