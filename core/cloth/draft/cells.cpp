#include "core/cloth/draft/cells.hpp"

#include <cassert>

#include "core/error.hpp"
#include "core/math/quadrature.hpp"

namespace gambeson {

void checkTrims(const Garment& garment) {
  if (!garment.trims.empty() && garment.trims.size() != garment.patches.size())
    throw InputError({"", 0, "trims"}, "must be empty or hold one entry per patch");
}

bool isTrimmed(const Garment& garment, int patch) {
  return !garment.trims.empty() && !garment.trims[patch].loops.empty();
}

std::vector<SheetCell> sheetCells(const Garment& garment) {
  checkTrims(garment);
  std::vector<SheetCell> cells;
  for (int index = 0; index < static_cast<int>(garment.patches.size()); ++index) {
    const NurbsPatch& patch = garment.patches[index];
    const auto us = breakpoints(patch.u), vs = breakpoints(patch.v);
    std::vector<TrimmedCell> trimmed;
    if (isTrimmed(garment, index)) try {
        trimmed = trimCells(patch, garment.trims[index]);
      } catch (const InputError& e) {
        throw InputError({"", 0, "trims[" + std::to_string(index) + "]." + e.where().key}, e.reason());
      }
    for (std::size_t j = 0; j + 1 < vs.size(); ++j)
      for (std::size_t i = 0; i + 1 < us.size(); ++i) {
        SheetCell cell;
        cell.patch = index;
        cell.su = findSpan(patch.u, 0.5 * (us[i] + us[i + 1]));
        cell.sv = findSpan(patch.v, 0.5 * (vs[j] + vs[j + 1]));
        cell.u0 = us[i], cell.u1 = us[i + 1], cell.v0 = vs[j], cell.v1 = vs[j + 1];
        if (!trimmed.empty()) {
          TrimmedCell& t = trimmed[i + (us.size() - 1) * j];
          if (t.kind == CellKind::outside) continue;
          cell.cut = t.kind == CellKind::cut;
          cell.points = std::move(t.points);
        }
        cells.push_back(std::move(cell));
      }
  }
  return cells;
}

std::vector<CellPoint> cellRule(const SheetCell& cell, int per_direction_u, int per_direction_v) {
  assert(per_direction_u > 0 && per_direction_v > 0);
  if (cell.cut) return cell.points;
  const Quadrature ru = gaussLegendre(per_direction_u), rv = gaussLegendre(per_direction_v);
  const double du = cell.u1 - cell.u0, dv = cell.v1 - cell.v0;
  std::vector<CellPoint> points;
  for (int j = 0; j < per_direction_v; ++j)
    for (int i = 0; i < per_direction_u; ++i)
      points.push_back(
          {cell.u0 + ru.points[i] * du, cell.v0 + rv.points[j] * dv, ru.weights[i] * rv.weights[j] * du * dv});
  return points;
}

}  // namespace gambeson
