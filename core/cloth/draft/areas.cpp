#include "core/cloth/draft/areas.hpp"

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/seams.hpp"

namespace gambeson {
namespace {

/// ∫ weight N dA at rest for each control point; weight(patch, uv).
std::vector<double> integrate(const Garment& garment, const auto& weight) {
  const std::vector<int> offsets = controlOffsets(garment);
  std::vector<double> area(offsets.back(), 0);
  for (const SheetCell& cell : sheetCells(garment)) {
    const NurbsPatch& patch = garment.patches[cell.patch];
    for (const CellPoint& point : cellRule(cell, patch.u.degree + 1, patch.v.degree + 1)) {
      const SurfaceBasis basis = surfaceBasis(patch, point.u, point.v);
      Vec3 A1{}, A2{};
      for (std::size_t k = 0; k < basis.columns.size(); ++k) {
        A1 += basis.values[1][k] * patch.points[basis.columns[k]];
        A2 += basis.values[2][k] * patch.points[basis.columns[k]];
      }
      const double dA = norm(cross(A1, A2)) * point.weight * weight(cell.patch, Vec2{point.u, point.v});
      for (std::size_t k = 0; k < basis.columns.size(); ++k)
        area[offsets[cell.patch] + basis.columns[k]] += basis.values[0][k] * dA;
    }
  }
  return area;
}

}  // namespace

std::vector<double> controlAreas(const Garment& garment) {
  return integrate(garment, [](int, Vec2) { return 1.0; });
}

std::vector<double> controlMasses(const Garment& garment) {
  const double density = garment.fabric.surfaceDensity();
  return integrate(garment, [&](int patch, Vec2 uv) {
    return fabricVaries(garment, patch) ? surfaceDensityAt(garment, patch, uv) : density;
  });
}

}  // namespace gambeson
