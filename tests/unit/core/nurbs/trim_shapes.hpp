#pragma once
/// Trimming loops for the tests.

#include <vector>

#include "core/math/quadrature.hpp"
#include "core/nurbs/trim.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson::shapes {

inline NurbsPatch unitPatch(int degree, int cells) {
  return flatPatch(uniformKnots(degree, cells), uniformKnots(degree, cells), 1, 1);
}

/// u -> 1 - u; run backwards, so that the kept side stays to the left.
inline TrimLoop mirroredU(const TrimLoop& loop) {
  TrimLoop out;
  for (auto it = loop.rbegin(); it != loop.rend(); ++it) {
    out.push_back(reversed(*it));
    for (Vec2& p : out.back().points) p.x = 1 - p.x;
  }
  return out;
}

/// u <-> v; run backwards.
inline TrimLoop swappedUV(const TrimLoop& loop) {
  TrimLoop out;
  for (auto it = loop.rbegin(); it != loop.rend(); ++it) {
    out.push_back(reversed(*it));
    for (Vec2& p : out.back().points) p = {p.y, p.x};
  }
  return out;
}

/// The kept points of all cells, whole cells by the tensor rule.
inline std::vector<CellPoint> allPoints(const NurbsPatch& patch, const Trim& trim) {
  const auto us = breakpoints(patch.u), vs = breakpoints(patch.v);
  const Quadrature rule = gaussLegendre(trim.points_per_piece > 0 ? trim.points_per_piece : patch.u.degree + 1);
  const auto cells = trimCells(patch, trim);
  std::vector<CellPoint> out;
  for (std::size_t j = 0; j + 1 < vs.size(); ++j)
    for (std::size_t i = 0; i + 1 < us.size(); ++i) {
      const TrimmedCell& c = cells[i + (us.size() - 1) * j];
      out.insert(out.end(), c.points.begin(), c.points.end());
      if (c.kind != CellKind::inside) continue;
      for (std::size_t b = 0; b < rule.points.size(); ++b)
        for (std::size_t a = 0; a < rule.points.size(); ++a)
          out.push_back({us[i] + rule.points[a] * (us[i + 1] - us[i]), vs[j] + rule.points[b] * (vs[j + 1] - vs[j]),
                         rule.weights[a] * rule.weights[b] * (us[i + 1] - us[i]) * (vs[j + 1] - vs[j])});
    }
  return out;
}

inline double keptArea(const NurbsPatch& patch, const Trim& trim) {
  double area = 0;
  for (const CellPoint& p : allPoints(patch, trim)) area += p.weight;
  return area;
}

}  // namespace gambeson::shapes
