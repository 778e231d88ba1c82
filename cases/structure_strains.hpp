#pragma once
/// Strains of weft and warp over the sheet: at the vertices of the knot mesh, where limits act, and at Gauss points.
/// Where a strain is taken matters: at a held corner the vertex stretches several times as far as the points beside it.

#include <nlohmann/json.hpp>

#include "cases/structure_results.hpp"
#include "core/dynamics/strain_points.hpp"

namespace gambeson {

/// Lives no longer than the structure.
class ThreadStrains {
 public:
  explicit ThreadStrains(const Structure& structure);
  /// PLACE_THREAD_max (the largest stretch) and PLACE_THREAD_mean (of the absolute strain over the points) of vertex
  /// and gauss, weft and warp.
  static const std::vector<std::string>& columns();
  std::vector<double> values(const std::vector<Vec3>& control_points) const;

 private:
  const Structure& structure_;
  StrainRows rows_;
  std::vector<std::pair<int, Vec2>> gauss_;  ///< patch, parameters
};

/// {vertex: {weft: {largest: over the rows, mean: of the last row}, ...}, ...}.
nlohmann::ordered_json threadStrainSummary(const PathTable& path);

}  // namespace gambeson
