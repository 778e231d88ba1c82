#include "core/cloth/patches/consistent_mass.hpp"

#include <algorithm>
#include <utility>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/fields.hpp"
#include "core/cloth/draft/seams.hpp"

namespace gambeson {

MassIntegral consistentMass(const Garment& g) {
  const std::vector<int> offsets = controlOffsets(g);
  std::vector<std::vector<std::pair<int, double>>> rows(offsets.back());
  MassIntegral m;
  m.area.assign(offsets.back(), 0.0);
  std::vector<double> local;
  for (const SheetCell& cell : sheetCells(g)) {
    const NurbsPatch& patch = g.patches[cell.patch];
    std::vector<int> columns;
    for (const CellPoint& point : cellRule(cell, patch.u.degree + 1, patch.v.degree + 1)) {
      const SurfaceBasis basis = surfaceBasis(patch, point.u, point.v);
      const std::size_t n = basis.columns.size();
      if (columns.empty()) columns = basis.columns, local.assign(n * n, 0.0);
      Vec3 A1{}, A2{};
      for (std::size_t k = 0; k < n; ++k) {
        A1 += basis.values[1][k] * patch.points[basis.columns[k]];
        A2 += basis.values[2][k] * patch.points[basis.columns[k]];
      }
      const double dA = norm(cross(A1, A2)) * point.weight;
      const double dm = surfaceDensityAt(g, cell.patch, {point.u, point.v}) * dA;
      for (std::size_t i = 0; i < n; ++i) {
        m.area[offsets[cell.patch] + columns[i]] += basis.values[0][i] * dA;
        for (std::size_t j = 0; j < n; ++j) local[i * n + j] += basis.values[0][i] * basis.values[0][j] * dm;
      }
    }
    const std::size_t n = columns.size();
    for (std::size_t i = 0; i < n; ++i) {
      auto& row = rows[offsets[cell.patch] + columns[i]];
      for (std::size_t j = 0; j < n; ++j) {
        const int column = offsets[cell.patch] + columns[j];
        const auto at =
            std::lower_bound(row.begin(), row.end(), column, [](const auto& entry, int c) { return entry.first < c; });
        if (at != row.end() && at->first == column)
          at->second += local[i * n + j];
        else
          row.insert(at, {column, local[i * n + j]});
      }
    }
  }
  m.mass.column_count = offsets.back();
  for (const auto& row : rows) {
    for (const auto& [column, value] : row) m.mass.add(column, value);
    m.mass.endRow();
  }
  return m;
}

}  // namespace gambeson
