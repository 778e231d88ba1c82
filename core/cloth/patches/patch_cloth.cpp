#include "core/cloth/patches/patch_cloth.hpp"

#include <algorithm>
#include <utility>

#include "core/cloth/draft/areas.hpp"
#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/edge.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/draft/sewing.hpp"
#include "core/cloth/patches/bulge.hpp"
#include "core/cloth/patches/consistent_mass.hpp"
#include "core/cloth/patches/evened_masses.hpp"
#include "core/cloth/patches/patch_mounting.hpp"
#include "core/cloth/patches/strain_points.hpp"
#include "core/cloth/patches/surface.hpp"
#include "core/error.hpp"
#include "core/nurbs/trim_mesh.hpp"

namespace gambeson {
namespace {

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

Garment checked(Garment garment) {
  checkGarment(garment);
  return garment;
}

}  // namespace

PatchCloth::PatchCloth(Garment garment)
    : garment_(checked(std::move(garment))),
      map_(buildFreeMap(garment_)),
      rest_(restControls(garment_)),
      patches_(patchesOf(garment_)),
      mounting_(patchMounting(garment_)) {}

PatchCloth::PatchCloth(const NodalDraft& draft) : PatchCloth(heldAtNodes(draft.garment)) {
  of_control_ = draft.of_control;
}

PatchCloth::~PatchCloth() = default;

int PatchCloth::draftPoints() const { return of_control_.rows() > 0 ? of_control_.column_count : points(); }

std::vector<Vec3> PatchCloth::fromDraft(std::span<const Vec3> control) const {
  if (of_control_.rows() == 0) return {control.begin(), control.end()};
  std::vector<Vec3> nodes(rest_.size());
  of_control_.multiply<Vec3>(control, nodes);
  return nodes;
}

std::string PatchCloth::describePoint(int point) const {
  int patch = 0;
  while (patches_[static_cast<std::size_t>(patch)].end_point <= point) ++patch;
  const int columns = garment_.patches[static_cast<std::size_t>(patch)].u.count(),
            local = point - patches_[static_cast<std::size_t>(patch)].first_point;
  return "control point (" + std::to_string(local % columns) + ", " + std::to_string(local / columns) + ") of patch " +
         std::to_string(patch);
}

SewnRows PatchCloth::sewnRows() const { return buildSewnRows(garment_, SeamHold::projected); }

Surface PatchCloth::surface(std::span<const int> per_cell) const { return buildSurface(garment_, map_, per_cell); }

Bulges PatchCloth::bulges(const Surface& surface, std::span<const int> per_cell) const {
  return buildBulges(garment_, surface, per_cell);
}

SparseRows PatchCloth::finer(int fineness, std::span<const int> per_cell) const {
  SparseRows rows;
  int first = 0;
  for (std::size_t p = 0; p < garment_.patches.size(); ++p) {
    const NurbsPatch& patch = garment_.patches[p];
    const int parts = fineness * std::max(1, per_cell[p]);  // 0: Greville points, one per cell
    const bool trimmed = isTrimmed(garment_, static_cast<int>(p));
    // Just inside of the patch's border, for a loop may run along it.
    const auto inward = [](const KnotVector& k, double at) { return at + 1e-6 * (0.5 * (k.front() + k.back()) - at); };
    for (const double v : sampleParameters(patch.v, parts))
      for (const double u : sampleParameters(patch.u, parts)) {
        if (trimmed && !isKept(patch, garment_.trims[p], {inward(patch.u, u), inward(patch.v, v)})) continue;
        const SurfaceBasis basis = surfaceBasis(patch, u, v);
        for (std::size_t k = 0; k < basis.columns.size(); ++k) rows.add(first + basis.columns[k], basis.values[0][k]);
        rows.endRow();
      }
    first += patch.size();
  }
  rows.column_count = first;
  return rows;
}

PlaceMesh PatchCloth::placeMesh(int per_cell) const {
  PlaceMesh mesh;
  for (std::size_t p = 0; p < garment_.patches.size(); ++p) {
    const NurbsPatch& patch = garment_.patches[p];
    const std::vector<double> us = sampleParameters(patch.u, per_cell), vs = sampleParameters(patch.v, per_cell);
    const int first = static_cast<int>(mesh.uv.size()), across = static_cast<int>(us.size());
    const auto point = [&](Vec2 uv) {
      mesh.patch.push_back(static_cast<int>(p));
      mesh.uv.push_back(uv);
      mesh.fraction.push_back({(uv.x - patch.u.front()) / (patch.u.back() - patch.u.front()),
                               (uv.y - patch.v.front()) / (patch.v.back() - patch.v.front())});
    };
    if (isTrimmed(garment_, static_cast<int>(p))) {
      const TrimMesh cut = trimMesh(patch, garment_.trims[p], us, vs);
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

Fabric PatchCloth::fabricAt(int patch, Vec2 uv) const { return gambeson::fabricAt(garment_, patch, uv); }

/// Measured through the cell's middle: a cell whose edge is a point has a side too.
double PatchCloth::cellAt(int patch_index, Vec2 at) const {
  const NurbsPatch& patch = garment_.patches[static_cast<std::size_t>(patch_index)];
  const int i = findSpan(patch.u, at.x), j = findSpan(patch.v, at.y);
  const double u0 = patch.u.knots[i], u1 = patch.u.knots[i + 1], v0 = patch.v.knots[j], v1 = patch.v.knots[j + 1];
  const double u = 0.5 * (u0 + u1), v = 0.5 * (v0 + v1);
  const auto x = [&](double a, double b) { return surfaceDerivatives(patch, a, b)[0]; };
  return std::min(norm(x(u1, v) - x(u0, v)), norm(x(u, v1) - x(u, v0)));
}

/// Of the control nets, without edges of no length.
std::vector<NetEdge> PatchCloth::net() const {
  std::vector<NetEdge> edges;
  int offset = 0;
  for (const NurbsPatch& patch : garment_.patches) {
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

std::vector<PatchLayout> PatchCloth::geometry() const {
  std::vector<PatchLayout> out;
  for (std::size_t p = 0; p < garment_.patches.size(); ++p)
    out.push_back(
        layoutOf(patches_[p].name, garment_.patches[p], garment_.trims.empty() ? nullptr : &garment_.trims[p]));
  return out;
}

std::vector<double> PatchCloth::areas() const { return controlAreas(garment_); }
std::vector<double> PatchCloth::masses() const { return controlMasses(garment_); }
std::vector<double> PatchCloth::evenedMasses(double share) const { return gambeson::evenedMasses(garment_, share); }
SparseRows PatchCloth::consistentMass() const { return gambeson::consistentMass(garment_).mass; }

StrainRows PatchCloth::strainRows(Mobility mobility, LimitPoints points) const {
  return buildStrainRows(garment_, map_, std::move(mobility), points);
}

Vec2 PatchCloth::limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv) const {
  return gambeson::limitStressAt(rows, field, patch, uv);
}

}  // namespace gambeson
