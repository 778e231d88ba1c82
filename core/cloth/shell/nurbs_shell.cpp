#include "core/cloth/shell/nurbs_shell.hpp"
#include "core/cloth/draft/areas.hpp"

#include <algorithm>
#include <cmath>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/edge.hpp"
#include "core/cloth/shell/bulge.hpp"
#include "core/cloth/shell/evened_masses.hpp"
#include "core/cloth/shell/shell_mass.hpp"
#include "core/cloth/shell/shell_mounting.hpp"
#include "core/cloth/shell/strain_points.hpp"
#include "core/cloth/shell/stress_field.hpp"
#include "core/cloth/shell/surface.hpp"
#include "core/cloth/shell/tangent.hpp"
#include "core/nurbs/trim_mesh.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

class ShellTangent : public ClothTangent {
 public:
  ShellTangent(const Shell& shell, const FreeMap& map) : shell_(shell), tangent_(shell, map) {}
  const BlockMatrix& sparsity() const override { return tangent_.sparsity(); }
  void assemble(const ClothState& state, ClothWork& work, BlockMatrix& K, const ForceTerms& terms) const override {
    tangent_.assemble(shell_, state, work, K, terms);
  }

 private:
  const Shell& shell_;
  Tangent tangent_;
};

std::vector<ClothPatch> patchesOf(const Garment& garment) {
  const std::vector<int> offsets = controlOffsets(garment);
  std::vector<ClothPatch> out;
  for (std::size_t p = 0; p < garment.patches.size(); ++p) {
    const KnotVector &u = garment.patches[p].u, &v = garment.patches[p].v;
    out.push_back({garment.patch_names.empty() ? "" : garment.patch_names[p],
                   garment.garmentOf(static_cast<int>(p)),
                   offsets[p],
                   offsets[p + 1],
                   {u.front(), v.front()},
                   {u.back(), v.back()},
                   {}});
  }
  for (const Seam& seam : garment.seams)
    for (const PatchEdge& e : {seam.a, seam.b})
      out[static_cast<std::size_t>(e.patch)].sewn[static_cast<std::size_t>(e.side)] = true;
  return out;
}

PatchLayout layoutOf(const std::string& name, const NurbsPatch& p, const Trim* trim) {
  PatchLayout layout{name, p.u.degree, p.v.degree, p.u.knots, p.v.knots, p.weights, {}};
  for (std::size_t l = 0; trim && l < trim->loops.size(); ++l)
    for (const NurbsCurve& c : trim->loops[l]) {
      layout.trims.push_back({static_cast<int>(l), c.knots.degree, c.knots.knots, {}, c.weights});
      for (const Vec2& uv : c.points) layout.trims.back().points.insert(layout.trims.back().points.end(), {uv.x, uv.y});
    }
  return layout;
}

const Garment& checked(const Garment& garment) {
  if (!garment.garment_of_patch.empty() && garment.garment_of_patch.size() != garment.patches.size())
    throw InputError({"", 0, "garment_of_patch"}, "one number for each patch is needed");
  return garment;
}

}  // namespace

NurbsShell::NurbsShell(const Garment& garment, const ShellOptions& o)
    : shell_(checked(garment), o.kernels ? *o.kernels : widestKernels(), o.gauss_extra, o.rule),
      map_(buildFreeMap(garment)),
      rest_(restControls(garment)),
      patches_(patchesOf(garment)),
      mounting_(shellMounting(shell_.garment())) {}

NurbsShell::~NurbsShell() = default;

std::string NurbsShell::describePoint(int point) const {
  int patch = 0;
  while (patches_[static_cast<std::size_t>(patch)].end_point <= point) ++patch;
  const int columns = garment().patches[static_cast<std::size_t>(patch)].u.count(),
            local = point - patches_[static_cast<std::size_t>(patch)].first_point;
  return "control point (" + std::to_string(local % columns) + ", " + std::to_string(local / columns) + ") of patch " +
         std::to_string(patch);
}

Surface NurbsShell::surface(std::span<const int> per_cell) const { return buildSurface(garment(), map_, per_cell); }

Bulges NurbsShell::bulges(const Surface& surface, std::span<const int> per_cell) const {
  return buildBulges(garment(), surface, per_cell);
}

SparseRows NurbsShell::finer(int fineness, std::span<const int> per_cell) const {
  SparseRows rows;
  int first = 0;
  for (std::size_t p = 0; p < garment().patches.size(); ++p) {
    const NurbsPatch& patch = garment().patches[p];
    const int parts = fineness * std::max(1, per_cell[p]);  // 0: Greville points, one per cell
    const bool trimmed = isTrimmed(garment(), static_cast<int>(p));
    // Just inside of the patch's border, for a loop may run along it.
    const auto inward = [](const KnotVector& k, double at) { return at + 1e-6 * (0.5 * (k.front() + k.back()) - at); };
    for (const double v : sampleParameters(patch.v, parts))
      for (const double u : sampleParameters(patch.u, parts)) {
        if (trimmed && !isKept(patch, garment().trims[p], {inward(patch.u, u), inward(patch.v, v)})) continue;
        const SurfaceBasis basis = surfaceBasis(patch, u, v);
        for (std::size_t k = 0; k < basis.columns.size(); ++k) rows.add(first + basis.columns[k], basis.values[0][k]);
        rows.endRow();
      }
    first += patch.size();
  }
  rows.column_count = first;
  return rows;
}

PlaceMesh NurbsShell::placeMesh(int per_cell) const {
  PlaceMesh mesh;
  for (std::size_t p = 0; p < garment().patches.size(); ++p) {
    const NurbsPatch& patch = garment().patches[p];
    const std::vector<double> us = sampleParameters(patch.u, per_cell), vs = sampleParameters(patch.v, per_cell);
    const int first = static_cast<int>(mesh.uv.size()), across = static_cast<int>(us.size());
    const auto point = [&](Vec2 uv) {
      mesh.patch.push_back(static_cast<int>(p));
      mesh.uv.push_back(uv);
      mesh.fraction.push_back({(uv.x - patch.u.front()) / (patch.u.back() - patch.u.front()),
                               (uv.y - patch.v.front()) / (patch.v.back() - patch.v.front())});
    };
    if (isTrimmed(garment(), static_cast<int>(p))) {
      const TrimMesh cut = trimMesh(patch, garment().trims[p], us, vs);
      for (const Vec2& uv : cut.uv) point(uv);
      for (const auto& t : cut.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      continue;
    }
    for (const double v : vs)
      for (const double u : us) point({u, v});
    for (int j = 0; j + 1 < static_cast<int>(vs.size()); ++j)
      for (int i = 0; i + 1 < across; ++i) {
        const int k = first + i + across * j;
        mesh.triangles.push_back({k, k + 1, k + across + 1});
        mesh.triangles.push_back({k, k + across + 1, k + across});
      }
  }
  return mesh;
}

Fabric NurbsShell::fabricAt(int patch, Vec2 uv) const { return gambeson::fabricAt(garment(), patch, uv); }

/// Measured through the cell's middle: a cell whose edge is a point has a side too.
double NurbsShell::cellAt(int patch_index, Vec2 at) const {
  const NurbsPatch& patch = garment().patches[static_cast<std::size_t>(patch_index)];
  const int i = findSpan(patch.u, at.x), j = findSpan(patch.v, at.y);
  const double u0 = patch.u.knots[i], u1 = patch.u.knots[i + 1], v0 = patch.v.knots[j], v1 = patch.v.knots[j + 1];
  const double u = 0.5 * (u0 + u1), v = 0.5 * (v0 + v1);
  const auto x = [&](double a, double b) { return surfaceDerivatives(patch, a, b)[0]; };
  return std::min(norm(x(u1, v) - x(u0, v)), norm(x(u, v1) - x(u, v0)));
}

/// Of the control nets, without edges of no length.
std::vector<NetEdge> NurbsShell::net() const {
  std::vector<NetEdge> edges;
  int offset = 0;
  for (const NurbsPatch& patch : garment().patches) {
    const auto add = [&](int a, int b) {
      const double length2 = norm2(patch.points[b] - patch.points[a]);
      if (length2 > 0) edges.push_back({offset + a, offset + b, 1 / length2});
    };
    for (int j = 0; j < patch.v.count(); ++j)
      for (int i = 0; i < patch.u.count(); ++i) {
        if (i + 1 < patch.u.count()) add(patch.index(i, j), patch.index(i + 1, j));
        if (j + 1 < patch.v.count()) add(patch.index(i, j), patch.index(i, j + 1));
      }
    offset += patch.size();
  }
  return edges;
}

std::vector<PatchLayout> NurbsShell::geometry() const {
  std::vector<PatchLayout> out;
  for (std::size_t p = 0; p < garment().patches.size(); ++p)
    out.push_back(
        layoutOf(patches_[p].name, garment().patches[p], garment().trims.empty() ? nullptr : &garment().trims[p]));
  return out;
}

std::vector<double> NurbsShell::areas() const { return controlAreas(garment()); }
std::vector<double> NurbsShell::masses() const { return controlMasses(garment()); }
std::vector<double> NurbsShell::evenedMasses(double share) const { return gambeson::evenedMasses(garment(), share); }
SparseRows NurbsShell::consistentMass() const { return gambeson::consistentMass(garment()).mass; }

void NurbsShell::force(const ClothState& state, const ClothForce& out, ClothWork& work, const ForceTerms& terms) const {
  shell_.force(state, out, work, terms);
}

std::unique_ptr<ClothTangent> NurbsShell::tangent() const { return std::make_unique<ShellTangent>(shell_, map_); }

std::unique_ptr<StressView> NurbsShell::stress() const { return std::make_unique<StressField>(shell_); }

PointState NurbsShell::stateAt(const ClothState& state, int patch, Vec2 uv) const {
  return shell_.stateAt(patch, uv, state);
}

double NurbsShell::bendAt(const ClothState& state, int patch, Vec2 uv) const {
  return shell_.bendAt(patch, uv, state.q);
}

std::vector<std::pair<int, Vec2>> NurbsShell::lawPlaces() const {
  std::vector<std::pair<int, Vec2>> places;
  for (const SheetCell& cell : sheetCells(garment())) {
    const NurbsPatch& patch = garment().patches[static_cast<std::size_t>(cell.patch)];
    for (const CellPoint& point : cellRule(cell, patch.u.degree, patch.v.degree))
      places.emplace_back(cell.patch, Vec2{point.u, point.v});
  }
  return places;
}

bool NurbsShell::springsAtRest(double length_m) const {
  const Garment& g = garment();
  if (hasRestCurvature(g.fabric)) return false;
  for (int p = 0; p < static_cast<int>(g.patches.size()); ++p)
    for (double u : grevillePoints(g.patches[static_cast<std::size_t>(p)].u))
      for (double v : grevillePoints(g.patches[static_cast<std::size_t>(p)].v)) {
        const Vec3 k = shell_.curvatureAt(p, {u, v}, rest_);
        if (std::max({std::abs(k.x), std::abs(k.y), std::abs(k.z)}) * length_m > 1e-6) return true;
      }
  return false;
}

StrainRows NurbsShell::strainRows(Mobility mobility, LimitPoints points) const {
  return buildStrainRows(garment(), map_, std::move(mobility), points);
}

Vec2 NurbsShell::limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv) const {
  return gambeson::limitStressAt(rows, field, patch, uv);
}

}  // namespace gambeson
