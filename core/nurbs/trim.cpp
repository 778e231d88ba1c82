#include "core/nurbs/trim.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/nurbs/trim_pieces.hpp"

namespace gambeson {

std::vector<TrimmedCell> trimCells(const NurbsPatch& patch, const Trim& trim) {
  if (trim.points_per_piece < 0 || trim.points_per_piece > 64)
    throw InputError({"", 0, "points_per_piece"}, std::to_string(trim.points_per_piece) + ", must be 0 to 64");
  if (!(trim.unused_fraction >= 0 && trim.unused_fraction < 1))
    throw InputError({"", 0, "unused_fraction"}, std::to_string(trim.unused_fraction) + ", must be in [0, 1)");
  const TrimBoundary boundary = trimBoundary(patch, trim);
  const std::vector<double> us = breakpoints(patch.u), vs = breakpoints(patch.v);
  const int nu = static_cast<int>(us.size()) - 1, nv = static_cast<int>(vs.size()) - 1;
  std::vector<std::vector<MonotoneArc>> arcs(static_cast<std::size_t>(nu) * nv);
  for (const MonotoneArc& arc : splitAtGrid(boundary, us, vs).arcs)
    if (const auto [i, j] = gridCell(arc, us, vs); i >= 0) arcs[i + static_cast<std::size_t>(nu) * j].push_back(arc);
  const int points = trim.points_per_piece > 0 ? trim.points_per_piece : std::max(patch.u.degree, patch.v.degree) + 1;
  const Quadrature rule = gaussLegendre(points);
  std::vector<TrimmedCell> cells(arcs.size());
  bool any = false;
  for (int j = 0; j < nv; ++j)
    for (int i = 0; i < nu; ++i) {
      TrimmedCell& cell = cells[i + static_cast<std::size_t>(nu) * j];
      const auto& here = arcs[i + static_cast<std::size_t>(nu) * j];
      if (here.empty()) {
        const bool kept = boundary.winding({0.5 * (us[i] + us[i + 1]), 0.5 * (vs[j] + vs[j + 1])}) > 0;
        cell.kind = kept ? CellKind::inside : CellKind::outside;
      } else {
        cell.points = cutCellPoints(boundary, here, us[i], us[i + 1], vs[j], vs[j + 1], rule);
        cell.kind = cell.points.empty() ? CellKind::outside : CellKind::cut;
      }
      any = any || cell.kind != CellKind::outside;
    }
  if (!any) throw InputError({"", 0, "loops"}, "nothing of the patch is left");
  return cells;
}

bool isKept(const NurbsPatch& patch, const Trim& trim, Vec2 uv) { return trimBoundary(patch, trim).isKept(uv); }

std::vector<Vec2> trimIntersections(const NurbsPatch& patch, const Trim& trim) {
  const std::vector<double> us = breakpoints(patch.u), vs = breakpoints(patch.v);
  std::vector<Vec2> points;
  for (const MonotoneArc& arc : splitAtGrid(trimBoundary(patch, trim), us, vs).arcs)
    if (std::binary_search(us.begin(), us.end(), arc.a.x) || std::binary_search(vs.begin(), vs.end(), arc.a.y))
      points.push_back(arc.a);
  return points;
}

}  // namespace gambeson
