#pragma once
/// Strains of weft and warp over a sheet or garments: at the vertices of the knot mesh, where limits act, and at Gauss
/// points. Where a strain is taken matters: at a held corner the vertex stretches several times as far as the points
/// beside it.

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

#include "core/cloth/cloth.hpp"

namespace gambeson {

/// Lives no longer than the cloth.
class ThreadStrains {
 public:
  explicit ThreadStrains(const Cloth& cloth);
  /// PLACE_THREAD_max (the largest stretch) and PLACE_THREAD_mean (of the absolute strain over the points) of vertex
  /// and gauss, weft and warp.
  static const std::vector<std::string>& columns();
  std::vector<double> values(const std::vector<Vec3>& control_points) const;

 private:
  const Cloth& cloth_;
  StrainRows rows_;
  std::vector<std::pair<int, Vec2>> gauss_;
};

/// {vertex: {weft: {largest: over the rows, mean: of the last row}, ...}, ...} of rows of values, one or more, that
/// begin in column `first`.
nlohmann::ordered_json threadStrainSummary(const std::vector<std::vector<double>>& rows, std::size_t first = 0);

}  // namespace gambeson
