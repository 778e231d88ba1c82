#include "core/cloth/patches/surface.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "core/cloth/draft/areas.hpp"
#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/grid_lines.hpp"
#include "core/cloth/patches/sample_areas.hpp"
#include "core/cloth/patches/sewn_twins.hpp"
#include "core/error.hpp"
#include "core/nurbs/trim_mesh.hpp"

namespace gambeson {
namespace {

/// Which sides (u0, u1, v0, v1) of a patch are joined to others.
std::array<bool, 4> joinedSides(const Garment& garment, int patch) {
  std::array<bool, 4> joined{};
  for (const Seam& seam : garment.seams)
    for (const PatchEdge& e : {seam.a, seam.b})
      if (e.patch == patch) joined[static_cast<int>(e.side)] = true;
  return joined;
}

/// A third of the rest area of the triangles at each sample.
std::vector<double> tributaryAreas(const Garment& garment, const Surface& s) {
  std::vector<Vec3> Q, X(s.W.rows());
  for (const NurbsPatch& p : garment.patches) Q.insert(Q.end(), p.points.begin(), p.points.end());
  s.W.multiply<Vec3>(Q, X);
  std::vector<double> area(X.size(), 0.0);
  for (const auto& [a, b, c] : s.triangles)
    for (int i : {a, b, c}) area[static_cast<std::size_t>(i)] += norm(cross(X[b] - X[a], X[c] - X[a])) / 6;
  return area;
}

/// Triangles of a trimmed patch that get a sample at their middle, one after the other.
using Divided = std::vector<int>;

void divide(TrimMesh& mesh, const Divided& triangles) {
  for (const int t : triangles) {
    const auto [a, b, c] = mesh.triangles[static_cast<std::size_t>(t)];
    const auto at = [&](int p) { return mesh.uv[static_cast<std::size_t>(p)]; };
    const int m = static_cast<int>(mesh.uv.size());
    mesh.uv.push_back({(at(a).x + at(b).x + at(c).x) / 3, (at(a).y + at(b).y + at(c).y) / 3});
    mesh.triangles[static_cast<std::size_t>(t)] = {a, b, m};
    mesh.triangles.push_back({b, c, m});
    mesh.triangles.push_back({c, a, m});
  }
}

/// Adds the triangles of trimmed patches in whose middles `against` (SampleAreas) is highest; false where it is nowhere
/// above 0.
bool divideWhere(const Garment& garment, const FreeMap& map, const Surface& s, std::span<const double> against,
                 std::vector<Divided>& divided) {
  constexpr double kHigh = 0.1;  // of the highest
  std::vector<double> control(static_cast<std::size_t>(map.T.rows()));
  map.T.multiply<double>(against, control);
  const std::vector<int> offsets = controlOffsets(garment);
  std::vector<std::pair<double, int>> high;
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    const int p = s.triangle_patch[t];
    if (!isTrimmed(garment, p)) continue;
    Vec2 middle{};
    for (const int i : s.triangles[t]) {
      const Vec2 uv = s.parameters[static_cast<std::size_t>(i)];
      middle = {middle.x + uv.x / 3, middle.y + uv.y / 3};
    }
    const SurfaceBasis basis = surfaceBasis(garment.patches[static_cast<std::size_t>(p)], middle.x, middle.y);
    double value = 0;
    for (std::size_t k = 0; k < basis.columns.size(); ++k)
      value += basis.values[0][k] *
               control[static_cast<std::size_t>(offsets[static_cast<std::size_t>(p)] + basis.columns[k])];
    if (value > 0) high.push_back({-value, static_cast<int>(t)});
  }
  std::sort(high.begin(), high.end());
  std::set<int> beside;  // corners of those that are divided now: one sample in a place at a time
  for (const auto& [value, t] : high) {
    if (-value < kHigh * -high.front().first) break;
    const auto& corners = s.triangles[static_cast<std::size_t>(t)];
    if (std::any_of(corners.begin(), corners.end(), [&](int i) { return beside.contains(i); })) continue;
    beside.insert(corners.begin(), corners.end());
    const int p = s.triangle_patch[static_cast<std::size_t>(t)];
    const auto first = std::lower_bound(s.triangle_patch.begin(), s.triangle_patch.end(), p);
    divided[static_cast<std::size_t>(p)].push_back(t - static_cast<int>(first - s.triangle_patch.begin()));
  }
  return !high.empty();
}

/// All but the areas and the twins.
Surface sampled(const Garment& garment, const FreeMap& map, std::span<const int> per_cell,
                const std::vector<Divided>& divided) {
  const std::vector<int> offsets = controlOffsets(garment);
  const int patch_count = static_cast<int>(garment.patches.size());
  Surface s;
  std::vector<std::vector<double>> us(patch_count), vs(patch_count);
  std::vector<int> first{0};
  for (int p = 0; p < patch_count; ++p) {
    us[p] = sampleParameters(garment.patches[p].u, per_cell[p]);
    vs[p] = sampleParameters(garment.patches[p].v, per_cell[p]);
    s.patch_grid_size.push_back({static_cast<int>(us[p].size()), static_cast<int>(vs[p].size())});
    first.push_back(first.back() + static_cast<int>(us[p].size() * vs[p].size()));
  }
  // Samples on joined edges are one.
  std::vector<int> parent(first.back());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  for (const Seam& seam : garment.seams) {
    if (per_cell[seam.a.patch] != per_cell[seam.b.patch])
      throw InputError({"", 0, "sampling"}, "patches that a seam joins need the same number of samples per cell");
    const auto [nua, nva] = s.patch_grid_size[seam.a.patch];
    const auto [nub, nvb] = s.patch_grid_size[seam.b.patch];
    const auto a = gridEdge(nua, nva, seam.a), b = gridEdge(nub, nvb, seam.b);
    if (seam.onPart() && per_cell[seam.a.patch] == 0)
      throw InputError({"", 0, "sampling"},
                       "patches that a seam joins to a part of an edge need a number of samples per cell");
    const std::size_t from = seam.onPart() ? static_cast<std::size_t>(seam.first_cell * per_cell[seam.a.patch]) : 0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      const int i = find(first[seam.a.patch] + a[k]), j = find(first[seam.b.patch] + b[from + k]);
      if (i != j) parent[std::max(i, j)] = std::min(i, j);
    }
  }
  std::vector<int> index(first.back(), -1);
  const auto addSample = [&](int p, Vec2 uv) {
    const SurfaceBasis basis = surfaceBasis(garment.patches[p], uv.x, uv.y);
    for (std::size_t k = 0; k < basis.columns.size(); ++k)
      if (basis.values[0][k] != 0) s.W.add(offsets[p] + basis.columns[k], basis.values[0][k]);
    s.W.endRow();
    s.patch.push_back(p);
    s.parameters.push_back(uv);
    return s.W.rows() - 1;
  };
  s.W.column_count = offsets.back();
  s.patch_grid.resize(patch_count);
  s.edge_samples.resize(patch_count);
  for (int p = 0; p < patch_count; ++p) {
    const auto [nu, nv] = s.patch_grid_size[p];
    if (isTrimmed(garment, p)) {
      TrimMesh mesh = trimMesh(garment.patches[p], garment.trims[p], us[p], vs[p], joinedSides(garment, p));
      divide(mesh, divided[p]);
      std::vector<int> sample(mesh.uv.size(), -1);
      for (int raw = 0; raw < nu * nv; ++raw) {
        const int root = find(first[p] + raw), at = mesh.grid[raw];
        if (at >= 0 && root == first[p] + raw) index[root] = addSample(p, mesh.uv[at]);
        if (at >= 0) sample[at] = index[root];
        s.patch_grid[p].push_back(at < 0 ? -1 : index[root]);
      }
      for (std::size_t k = 0; k < mesh.uv.size(); ++k)
        if (sample[k] < 0) sample[k] = addSample(p, mesh.uv[k]);
      s.edge_samples[p].resize(4);
      for (int side = 0; side < 4; ++side) {
        const bool along_v = side < 2;
        const double line = side == 0   ? us[p].front()
                            : side == 1 ? us[p].back()
                            : side == 2 ? vs[p].front()
                                        : vs[p].back();
        std::vector<std::pair<double, int>> on;
        for (std::size_t k = 0; k < mesh.uv.size(); ++k)
          if ((along_v ? mesh.uv[k].x : mesh.uv[k].y) == line)
            on.push_back({along_v ? mesh.uv[k].y : mesh.uv[k].x, sample[k]});
        std::sort(on.begin(), on.end());
        for (const auto& entry : on) s.edge_samples[p][side].push_back(entry.second);
      }
      for (const auto& [a, b, c] : mesh.triangles) {
        s.triangles.push_back({sample[a], sample[b], sample[c]});
        s.triangle_patch.push_back(p);
        s.triangle_cell.push_back(cellBetween(us[p], (mesh.uv[a].x + mesh.uv[b].x + mesh.uv[c].x) / 3) +
                                  (nu - 1) * cellBetween(vs[p], (mesh.uv[a].y + mesh.uv[b].y + mesh.uv[c].y) / 3));
      }
      continue;
    }
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) {
        const int raw = first[p] + i + nu * j, root = find(raw);
        if (root == raw) {
          index[raw] = addSample(p, {us[p][i], vs[p][j]});
        }
        s.patch_grid[p].push_back(index[root]);
      }
    for (int j = 0; j + 1 < nv; ++j)
      for (int i = 0; i + 1 < nu; ++i) {
        const int a = s.patch_grid[p][i + nu * j], b = s.patch_grid[p][i + 1 + nu * j];
        const int c = s.patch_grid[p][i + 1 + nu * (j + 1)], d = s.patch_grid[p][i + nu * (j + 1)];
        if ((i + j) % 2 == 0) {
          s.triangles.push_back({a, b, c});
          s.triangles.push_back({a, c, d});
        } else {
          s.triangles.push_back({a, b, d});
          s.triangles.push_back({b, c, d});
        }
        s.triangle_patch.insert(s.triangle_patch.end(), 2, p);
        s.triangle_cell.insert(s.triangle_cell.end(), 2, i + (nu - 1) * j);
      }
  }
  s.WT = multiply(s.W, map.T);
  s.WTt = transpose(s.WT);
  return s;
}

}  // namespace

std::vector<double> sampleParameters(const KnotVector& knots, int per_cell) {
  if (per_cell == 0) return grevillePoints(knots);
  const std::vector<double> ends = breakpoints(knots);
  std::vector<double> at;
  for (std::size_t c = 0; c + 1 < ends.size(); ++c)
    for (int k = 0; k < per_cell; ++k) at.push_back(ends[c] + (ends[c + 1] - ends[c]) * k / per_cell);
  at.push_back(ends.back());
  return at;
}

Surface buildSurface(const Garment& garment, const FreeMap& map, int per_cell) {
  return buildSurface(garment, map, std::vector<int>(garment.patches.size(), per_cell));
}

Surface buildSurface(const Garment& garment, const FreeMap& map, std::span<const int> per_cell) {
  if (per_cell.size() != garment.patches.size())
    throw InputError({"", 0, "sampling"}, "one number of samples per cell for each patch is needed");
  const std::vector<double> area = controlAreas(garment);
  std::vector<double> free_area(static_cast<std::size_t>(map.T.column_count));
  map.Tt.multiply<double>(area, free_area);
  const bool trimmed = [&] {
    for (int p = 0; p < static_cast<int>(garment.patches.size()); ++p)
      if (isTrimmed(garment, p)) return true;
    return false;
  }();
  constexpr int kRounds = 40;
  std::vector<Divided> divided(garment.patches.size());
  for (int round = 0;; ++round) {
    Surface s = sampled(garment, map, per_cell, divided);
    if (trimmed) {
      SampleAreas found = positiveAreas(s.WT, free_area, tributaryAreas(garment, s));
      if (!found.against.empty()) {
        if (round < kRounds && divideWhere(garment, map, s, found.against, divided)) continue;
        throw InputError(
            {"", 0, "sampling"},
            (found.undecided ? "no positive areas of the surface samples were found that stand for the cloth"
                             : "no positive areas of the surface samples stand for the cloth") +
                std::string("; use another number of samples per cell"));
      }
      s.area_m2 = std::move(found.area_m2);
    } else {
      s.area_m2 = consistentAreas(s.WT, free_area);
    }
    for (int i = 0; i < s.size(); ++i)
      if (!(s.area_m2[i] > 0))
        throw InputError({"", 0, "sampling"},
                         "surface sample " + std::to_string(i) + " of patch " + std::to_string(s.patch[i]) + " at (" +
                             std::to_string(s.parameters[i].x) + ", " + std::to_string(s.parameters[i].y) +
                             ") would carry the area " + std::to_string(s.area_m2[i]) +
                             " m^2; choose another number of samples per cell");
    s.twins = sewnTwins(garment, s);
    return s;
  }
}

}  // namespace gambeson
