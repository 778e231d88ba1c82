#pragma once
/// Flat panels and their seams, for the tests.

#include <cmath>
#include <vector>

#include "core/cloth/draft/sewing.hpp"
#include "core/cloth/sewn_projection.hpp"
#include "unit/core/cloth/shell/sheet_shapes.hpp"

namespace gambeson::shapes {

inline KnotVector evenKnots(int degree, int cells, double from, double to) {
  std::vector<double> ends;
  for (int i = 0; i <= cells; ++i) ends.push_back(from + (to - from) * i / cells);
  return knotsAt(degree, ends);
}

/// A flat rectangle whose parameters are lengths.
inline NurbsPatch panelPatch(int nu, int nv, Vec2 from, Vec2 to) {
  return patchOf(evenKnots(2, nu, from.x, to.x), evenKnots(2, nv, from.y, to.y), [](double a, double b) {
    return Vec3{a, b, 0};
  });
}

/// A sheet [0, length] x [0, width] that a curve in the shape of an S cuts in two panels, sewn; their cells do not
/// match. `apart`: at rest the second panel lies turned and elsewhere; `placed` is where both lie on the sheet.
struct CutSheet {
  double length = 0.3, width = 0.2;
  int cells = 10;  ///< along the width of the first panel
  SeamHold hold = SeamHold::weak;
  double stiffness_N = 0;
  double rows_per_cell = SewnSeam{}.rows_per_cell;
  bool apart = false;

  NurbsCurve cut() const {
    const double middle = 0.5 * length, swing = 0.2 * length;
    return {{3, {0, 0, 0, 0, 1, 1, 1, 1}},
            {{middle, 0}, {middle + swing, width / 3}, {middle - swing, 2 * width / 3}, {middle, width}},
            {1, 1, 1, 1}};
  }
  static Vec3 away(const Vec3& x) { return rotationAbout({0, 0, 1}, 0.7) * x + Vec3{0.5, -0.3, 0}; }
  Garment garment(const Fabric& fabric) const {
    const double middle = 0.5 * length, reach = 0.2 * length * std::sqrt(3) / 6 * 1.5;
    const double h = width / cells;
    const double a_end = middle + reach, b_from = middle - reach;
    const int other = cells + cells / 3 + 1;
    const double k = width / other;
    Garment g = garmentOf(
        {panelPatch(static_cast<int>(std::lround(a_end / h)), cells, {0, 0}, {a_end, width}),
         panelPatch(static_cast<int>(std::lround((length - b_from) / k)), other, {b_from, 0}, {length, width})},
        {}, fabric);
    const NurbsCurve s = cut();
    g.trims.resize(2);
    g.trims[0].loops = {{line({0, 0}, {middle, 0}), s, line({middle, width}, {0, width}), line({0, width}, {0, 0})}};
    g.trims[1].loops = {{line({middle, 0}, {length, 0}), line({length, 0}, {length, width}),
                         line({length, width}, {middle, width}), reversed(s)}};
    if (apart) {
      for (const NurbsPatch& p : g.patches) g.placed.push_back(p.points);
      for (Vec3& x : g.patches[1].points) x = away(x);
      g.weft[1] = rotationAbout({0, 0, 1}, 0.7) * g.weft[1];
    }
    SewnSeam seam{{loopPart(g, 0, 0, 1)}, {loopPart(g, 1, 0, 3, true)}, hold, stiffness_N};
    seam.rows_per_cell = rows_per_cell;
    g.sewn_seams = {seam};
    return g;
  }
  /// The same sheet in one piece.
  Garment whole(const Fabric& fabric, int across) const {
    return garmentOf(
        {panelPatch(static_cast<int>(std::lround(length / width * across)), across, {0, 0}, {length, width})}, {},
        fabric);
  }
};

inline Vec3 pointOf(const Garment& g, int patch, Vec2 uv, std::span<const Vec3> q) {
  const SurfaceBasis b = surfaceBasis(g.patches[patch], uv.x, uv.y);
  Vec3 x{};
  for (std::size_t k = 0; k < b.columns.size(); ++k) x += b.values[0][k] * q[controlOffsets(g)[patch] + b.columns[k]];
  return x;
}

}  // namespace gambeson::shapes
