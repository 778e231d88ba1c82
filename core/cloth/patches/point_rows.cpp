#include "core/cloth/patches/point_rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace gambeson {

PointRows rowsAt(const Garment& garment, const FreeMap& map, int offset, int patch_index, Vec2 uv) {
  const NurbsPatch& patch = garment.patches[patch_index];
  const SurfaceBasis basis = surfaceBasis(patch, uv.x, uv.y);
  Vec3 A1{}, A2{};
  for (std::size_t k = 0; k < basis.columns.size(); ++k) {
    A1 += basis.values[1][k] * patch.points[basis.columns[k]];
    A2 += basis.values[2][k] * patch.points[basis.columns[k]];
  }
  const Vec3 normal = cross(A1, A2);
  if (!(norm(normal) > 0)) throw InputError({"", 0, "patch"}, "the rest surface is degenerate (zero area)");
  const Vec3 n = normalized(normal);
  const Vec3 weft = rotationAbout(n, fibreAngleAt(garment, patch_index, uv)) * garment.weft[patch_index];
  const Vec3 E1 = normalized(weft - dot(weft, n) * n), E2 = cross(n, E1);
  // d(xi)/dX: the inverse of the rest tangents in the physical basis.
  const double J11 = dot(E1, A1), J12 = dot(E1, A2), J21 = dot(E2, A1), J22 = dot(E2, A2);
  const double det = J11 * J22 - J12 * J21;
  const Vec2 along_weft{J22 / det, -J21 / det}, along_warp{-J12 / det, J11 / det};
  PointRows rows;
  rows.threads = {A1, A2, along_weft, along_warp};
  for (std::size_t k = 0; k < basis.columns.size(); ++k) {
    const int c = offset + basis.columns[k];
    const double N = basis.values[0][k], Nu = basis.values[1][k], Nv = basis.values[2][k];
    for (int e = map.T.offsets[c]; e < map.T.offsets[c + 1]; ++e) {
      auto& entry = rows.entries[map.T.columns[e]];
      entry[0] += map.T.values[e] * N;
      entry[1] += map.T.values[e] * (along_weft.x * Nu + along_weft.y * Nv);
      entry[2] += map.T.values[e] * (along_warp.x * Nu + along_warp.y * Nv);
    }
  }
  return rows;
}

int RowTable::find(const PointRows& rows, int direction, SparseRows& B) {
  double size = 0;
  for (const auto& entry : rows.entries) size = std::max(size, std::abs(entry.second[direction]));
  std::vector<int> columns;
  std::vector<double> values;
  // A bucket is chosen by the large entries: the others may be rounding on one side of a seam.
  for (const auto& [column, entry] : rows.entries)
    if (std::abs(entry[direction]) > 1e-7 * size) {
      columns.push_back(column);
      values.push_back(entry[direction]);
    }
  auto& bucket = seen_[columns];
  for (const auto& [row, other] : bucket)
    for (double sign : {1., -1.}) {
      double most = 0;
      for (std::size_t k = 0; k < values.size(); ++k) most = std::max(most, std::abs(values[k] - sign * other[k]));
      if (most < 1e-9 * size) return row;
    }
  bucket.push_back({B.rows(), values});
  for (const auto& [column, entry] : rows.entries)
    if (std::abs(entry[direction]) > 1e-13 * size) B.add(column, entry[direction]);
  B.endRow();
  return B.rows() - 1;
}

}  // namespace gambeson
