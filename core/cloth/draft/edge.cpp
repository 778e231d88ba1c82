#include "core/cloth/draft/edge.hpp"

#include <algorithm>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/error.hpp"
#include "core/math/quadrature.hpp"

namespace gambeson {
namespace {

bool isClamped(const KnotVector& k) { return k.knots.front() == k.front() && k.knots.back() == k.back(); }
bool acrossIsU(Side side) { return side == Side::u0 || side == Side::u1; }
bool isFar(Side side) { return side == Side::u1 || side == Side::v1; }
}  // namespace

void checkEdge(const Garment& garment, const PatchEdge& edge, const std::string& key) {
  if (edge.patch < 0 || edge.patch >= static_cast<int>(garment.patches.size()))
    throw InputError({"", 0, key}, "patch " + std::to_string(edge.patch) + " does not exist");
  const NurbsPatch& patch = garment.patches[edge.patch];
  if (!isClamped(patch.u) || !isClamped(patch.v))
    throw InputError({"", 0, key}, "knots of patch " + std::to_string(edge.patch) + " must be clamped at their ends");
}

void checkPoint(const Garment& garment, int patch, Vec2 uv, const std::string& key) {
  if (patch < 0 || patch >= static_cast<int>(garment.patches.size()))
    throw InputError({"", 0, key}, "patch " + std::to_string(patch) + " does not exist");
  const NurbsPatch& p = garment.patches[patch];
  if (!(uv.x >= p.u.front() && uv.x <= p.u.back() && uv.y >= p.v.front() && uv.y <= p.v.back()))
    throw InputError({"", 0, key}, "the point (" + std::to_string(uv.x) + ", " + std::to_string(uv.y) +
                                       ") lies outside the parameters of patch " + std::to_string(patch));
  checkTrims(garment);
  if (isTrimmed(garment, patch) && !isKept(p, garment.trims[patch], uv))
    throw InputError({"", 0, key}, "the point (" + std::to_string(uv.x) + ", " + std::to_string(uv.y) + ") of patch " +
                                       std::to_string(patch) + " is cut away by its trimming loops");
}

const KnotVector& alongKnots(const NurbsPatch& patch, Side side) { return acrossIsU(side) ? patch.v : patch.u; }
const KnotVector& acrossKnots(const NurbsPatch& patch, Side side) { return acrossIsU(side) ? patch.u : patch.v; }

Vec2 edgeParameters(const Garment& garment, const PatchEdge& edge, double t) {
  const KnotVector& across = acrossKnots(garment.patches[edge.patch], edge.side);
  const double c = isFar(edge.side) ? across.back() : across.front();
  return acrossIsU(edge.side) ? Vec2{c, t} : Vec2{t, c};
}

EdgeBasis edgeBasis(const Garment& garment, const PatchEdge& edge, double t) {
  const NurbsPatch& patch = garment.patches[edge.patch];
  const int offset = controlOffsets(garment)[edge.patch];
  const bool across_u = acrossIsU(edge.side), far = isFar(edge.side);
  const Vec2 uv = edgeParameters(garment, edge, t);
  const SurfaceBasis basis = surfaceBasis(patch, uv.x, uv.y);
  EdgeBasis row;
  for (std::size_t k = 0; k < basis.columns.size(); ++k) {
    const double value = basis.values[0][k];
    const double along = (edge.reversed ? -1 : 1) * basis.values[across_u ? 2 : 1][k];
    const double inward = (far ? -1 : 1) * basis.values[across_u ? 1 : 2][k];
    if (value == 0 && along == 0 && inward == 0) continue;
    row.columns.push_back(offset + basis.columns[k]);
    row.value.push_back(value);
    row.along.push_back(along);
    row.inward.push_back(inward);
  }
  return row;
}

std::vector<std::pair<double, double>> keptRanges(const Garment& garment, const PatchEdge& edge) {
  const NurbsPatch& patch = garment.patches[edge.patch];
  const KnotVector& knots = alongKnots(patch, edge.side);
  checkTrims(garment);
  if (!isTrimmed(garment, edge.patch)) return {{knots.front(), knots.back()}};
  const Trim& trim = garment.trims[edge.patch];
  const bool across_u = acrossIsU(edge.side);
  const KnotVector& across = acrossKnots(patch, edge.side);
  const double c = isFar(edge.side) ? across.back() : across.front(),
               tolerance = 1e-9 * (across.back() - across.front());
  std::vector<double> ends{knots.front(), knots.back()};
  for (const Vec2& uv : trimIntersections(patch, trim))
    if (std::abs((across_u ? uv.x : uv.y) - c) <= tolerance)
      ends.push_back(std::clamp(across_u ? uv.y : uv.x, knots.front(), knots.back()));
  std::sort(ends.begin(), ends.end());
  std::vector<std::pair<double, double>> ranges;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (!(ends[i + 1] - ends[i] > 1e-12 * (knots.back() - knots.front()))) continue;
    if (!isKept(patch, trim, edgeParameters(garment, edge, 0.5 * (ends[i] + ends[i + 1])))) continue;
    if (!ranges.empty() && ranges.back().second >= ends[i])
      ranges.back().second = ends[i + 1];
    else
      ranges.emplace_back(ends[i], ends[i + 1]);
  }
  if (ranges.empty()) throw InputError({"", 0, edgeName(edge)}, "trimming leaves nothing of the edge");
  return ranges;
}

std::vector<bool> keptControls(const Garment& garment, const PatchEdge& edge) {
  const KnotVector& knots = alongKnots(garment.patches[edge.patch], edge.side);
  std::vector<bool> kept(knots.count(), false);
  for (const auto& [from, to] : keptRanges(garment, edge))
    for (int i = 0; i < knots.count(); ++i)
      if (knots.knots[i] < to && knots.knots[i + knots.degree + 1] > from) kept[i] = true;
  return kept;
}

std::vector<EdgePoint> edgePoints(const Garment& garment, const PatchEdge& edge, int per_cell) {
  const KnotVector& knots = alongKnots(garment.patches[edge.patch], edge.side);
  const std::vector<double> cells = breakpoints(knots);
  const Quadrature rule = gaussLegendre(per_cell > 0 ? per_cell : knots.degree + 3);
  const std::vector<Vec3> Q = restControls(garment);
  std::vector<EdgePoint> points;
  double length = 0;
  for (const auto& [from, to] : keptRanges(garment, edge))
    for (std::size_t cell = 0; cell + 1 < cells.size(); ++cell) {
      const double start = std::max(from, cells[cell]), range = std::min(to, cells[cell + 1]) - start;
      if (!(range > 0)) continue;
      for (std::size_t g = 0; g < rule.points.size(); ++g) {
        const double t = start + rule.points[g] * range;
        const EdgeBasis basis = edgeBasis(garment, edge, t);
        points.push_back({t, norm(combine(basis.columns, basis.along, Q)) * range * rule.weights[g]});
        length += points.back().length_m;
      }
    }
  if (!(length > 0)) throw InputError({"", 0, edgeName(edge)}, "the edge has no length at rest");
  return points;
}

std::vector<Vec3> restControls(const Garment& garment) {
  std::vector<Vec3> q;
  for (const NurbsPatch& p : garment.patches) q.insert(q.end(), p.points.begin(), p.points.end());
  return q;
}

}  // namespace gambeson
