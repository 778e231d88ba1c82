#pragma once
/// Strains of a thread at a point as rows on the free points. Internal to the builders of StrainRows.

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "core/cloth/draft/garment.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/math/sparse.hpp"

namespace gambeson {

/// Of the rest surface at a point: tangents, and d(u, v)/ds along weft and warp [1/m].
struct Threads {
  Vec3 A1, A2;
  Vec2 along_weft, along_warp;
};

/// N, weft and warp derivative of a point on the free points.
struct PointRows {
  std::map<int, std::array<double, 3>> entries;
  Threads threads;
};
/// `offset` is that of the patch's control points in the garment's.
PointRows rowsAt(const Garment& garment, const FreeMap& map, int offset, int patch, Vec2 uv);

/// Strains that are the same function of p are one: found by the free points that carry them.
class RowTable {
 public:
  /// The row with these entries up to their sign, which E does not see; a new one of B where there is none.
  int find(const PointRows& rows, int direction, SparseRows& B);

 private:
  std::map<std::vector<int>, std::vector<std::pair<int, std::vector<double>>>> seen_;
};

/// Quadrature at the Greville points of a spline space, exact on it.
struct GrevilleRule {
  std::vector<double> at, weight;
};
/// Throws InputError (reason only) where points coincide or a weight is not positive.
GrevilleRule grevilleRule(const KnotVector& knots);
/// The space of derivatives.
KnotVector derivativeKnots(const KnotVector& knots);

}  // namespace gambeson
