#include "core/cloth/patches/patch_loads.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/draft/edge.hpp"
#include "core/cloth/draft/fields.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/mounting.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

void checkPatch(const Garment& garment, int patch, const char* key) {
  if (patch < 0 || patch >= static_cast<int>(garment.patches.size()))
    throw InputError({"", 0, key}, "patch " + std::to_string(patch) + " does not exist");
}

/// Adds ∫ N b dA over one patch at rest; b(uv) [N/m^2].
template <class F>
void addSurface(const Garment& garment, int patch, F&& b, std::vector<Vec3>& force) {
  const NurbsPatch& p = garment.patches[patch];
  const int offset = controlOffsets(garment)[patch];
  for (const SheetCell& cell : sheetCells(garment)) {
    if (cell.patch != patch) continue;
    for (const CellPoint& point : cellRule(cell, p.u.degree + 1, p.v.degree + 1)) {
      const SurfaceBasis basis = surfaceBasis(p, point.u, point.v);
      const Vec3 area =
          cross(combine(basis.columns, basis.values[1], p.points), combine(basis.columns, basis.values[2], p.points));
      const Vec3 f = norm(area) * point.weight * b(Vec2{point.u, point.v});
      for (std::size_t k = 0; k < basis.columns.size(); ++k) force[offset + basis.columns[k]] += basis.values[0][k] * f;
    }
  }
}

std::vector<Vec3> zeroForce(const Garment& garment) { return std::vector<Vec3>(controlOffsets(garment).back()); }

}  // namespace

std::vector<Vec3> edgeForce(const Garment& garment, const PatchEdge& edge, const Vec3& force_N_per_m) {
  checkEdge(garment, edge, "edge load");
  checkFiniteLoad(force_N_per_m, "edge load");
  std::vector<Vec3> force = zeroForce(garment);
  for (const EdgePoint& point : edgePoints(garment, edge)) {
    const EdgeBasis basis = edgeBasis(garment, edge, point.t);
    for (std::size_t k = 0; k < basis.columns.size(); ++k)
      force[basis.columns[k]] += basis.value[k] * point.length_m * force_N_per_m;
  }
  return force;
}

std::vector<Vec3> surfaceForce(const Garment& garment, int patch, const Vec3& force_N_per_m2) {
  checkPatch(garment, patch, "surface load");
  checkFiniteLoad(force_N_per_m2, "surface load");
  std::vector<Vec3> force = zeroForce(garment);
  addSurface(
      garment, patch, [&](Vec2) { return force_N_per_m2; }, force);
  return force;
}

std::vector<Vec3> garmentForce(const Garment& garment, const Vec3& force_N_per_m2) {
  checkFiniteLoad(force_N_per_m2, "surface load");
  std::vector<Vec3> force = zeroForce(garment);
  for (int p = 0; p < static_cast<int>(garment.patches.size()); ++p)
    addSurface(
        garment, p, [&](Vec2) { return force_N_per_m2; }, force);
  return force;
}

std::vector<Vec3> pointForce(const Garment& garment, int patch, Vec2 uv, const Vec3& force_N) {
  checkPoint(garment, patch, uv, "point load");
  checkFiniteLoad(force_N, "point load");
  const SurfaceBasis basis = surfaceBasis(garment.patches[patch], uv.x, uv.y);
  const int offset = controlOffsets(garment)[patch];
  std::vector<Vec3> force = zeroForce(garment);
  for (std::size_t k = 0; k < basis.columns.size(); ++k)
    force[offset + basis.columns[k]] += basis.values[0][k] * force_N;
  return force;
}

std::vector<Vec3> weightForce(const Garment& garment, const Vec3& gravity_m_per_s2) {
  checkFiniteLoad(gravity_m_per_s2, "gravity");
  std::vector<Vec3> force = zeroForce(garment);
  for (int p = 0; p < static_cast<int>(garment.patches.size()); ++p)
    addSurface(
        garment, p, [&](Vec2 uv) { return surfaceDensityAt(garment, p, uv) * gravity_m_per_s2; }, force);
  return force;
}

std::vector<PressureLoad> garmentPressure(const Garment& garment, double pressure_Pa, int program) {
  std::vector<PressureLoad> loads;
  for (int p = 0; p < static_cast<int>(garment.patches.size()); ++p) loads.push_back({p, pressure_Pa, program});
  return loads;
}

std::vector<FollowingLoad> pressureOn(const Garment& garment, int patch_index, double pressure_Pa) {
  checkPatch(garment, patch_index, "pressure");
  std::vector<FollowingLoad> loads;
  const std::vector<int> offsets = controlOffsets(garment);
  const NurbsPatch& patch = garment.patches[patch_index];
  // N (x,u x x,v) of a polynomial patch has the degree 3p - 1 in u, 3q - 1 in v: integrated exactly, so that the
  // force is the gradient of the enclosed volume to rounding. A rational one converges; it takes a point more.
  const bool rational =
      std::any_of(patch.weights.begin(), patch.weights.end(), [&](double w) { return w != patch.weights.front(); });
  const int gu = std::max(patch.u.degree + 1, (3 * patch.u.degree + 1) / 2) + rational;
  const int gv = std::max(patch.v.degree + 1, (3 * patch.v.degree + 1) / 2) + rational;
  for (const SheetCell& cell : sheetCells(garment)) {
    if (cell.patch != patch_index) continue;
    FollowingLoad load;
    load.pressure = true;
    for (const CellPoint& point : cellRule(cell, gu, gv)) {
      const SurfaceBasis basis = surfaceBasis(patch, point.u, point.v);
      if (load.columns.empty())
        for (int column : basis.columns) load.columns.push_back(offsets[patch_index] + column);
      load.points.push_back({basis.values[0], basis.values[1], basis.values[2], pressure_Pa * point.weight});
    }
    loads.push_back(std::move(load));
  }
  return loads;
}

std::vector<FollowingLoad> edgeMomentOn(const Garment& garment, const PatchEdge& edge, double moment_N) {
  checkEdge(garment, edge, "edge moment");
  const std::vector<Vec3> Q = restControls(garment);
  std::vector<FollowingLoad> pieces;
  for (const EdgePoint& point : edgePoints(garment, edge)) {
    EdgeBasis basis = edgeBasis(garment, edge, point.t);
    const Vec3 xt = combine(basis.columns, basis.along, Q), xc = combine(basis.columns, basis.inward, Q);
    if (!(norm(cross(xt, xc)) > 1e-9 * (norm2(xt) + norm2(xc))))
      throw InputError({"", 0, "edge moment"}, "the rest surface has no normal on " + edgeName(edge));
    if (pieces.empty() || pieces.back().columns != basis.columns) {
      pieces.emplace_back();
      pieces.back().columns = basis.columns;
    }
    pieces.back().points.push_back({{}, std::move(basis.along), std::move(basis.inward), moment_N * point.length_m});
  }
  return pieces;
}

}  // namespace gambeson
