#include "core/sheet/surface.hpp"

#include <Eigen/SparseCholesky>
#include <cmath>
#include <map>
#include <numeric>

#include "core/error.hpp"
#include "core/sheet/cells.hpp"

namespace gambeson {
namespace {

std::vector<double> sampleParameters(const KnotVector& knots, int per_cell) {
  if (per_cell == 0) return grevillePoints(knots);
  const std::vector<double> ends = breakpoints(knots);
  std::vector<double> at;
  for (std::size_t c = 0; c + 1 < ends.size(); ++c)
    for (int k = 0; k < per_cell; ++k) at.push_back(ends[c] + (ends[c + 1] - ends[c]) * k / per_cell);
  at.push_back(ends.back());
  return at;
}

/// Indices of the samples along an edge in a grid of nu x nv, in the edge's sense.
std::vector<int> gridEdge(int nu, int nv, const PatchEdge& e) {
  std::vector<int> at;
  const bool along_v = e.side == Side::u0 || e.side == Side::u1;
  const int n = along_v ? nv : nu;
  for (int k = 0; k < n; ++k) {
    const int t = e.reversed ? n - 1 - k : k;
    switch (e.side) {
      case Side::u0:
        at.push_back(nu * t);
        break;
      case Side::u1:
        at.push_back(nu - 1 + nu * t);
        break;
      case Side::v0:
        at.push_back(t);
        break;
      case Side::v1:
        at.push_back(t + nu * (nv - 1));
        break;
    }
  }
  return at;
}

std::vector<double> consistentAreas(const SparseRows& WT, const std::vector<double>& free_area) {
  using Matrix = Eigen::SparseMatrix<double>;
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < WT.rows(); ++r)
    for (int k = WT.offsets[r]; k < WT.offsets[r + 1]; ++k) entries.emplace_back(r, WT.columns[k], WT.values[k]);
  Matrix W(WT.rows(), WT.column_count);
  W.setFromTriplets(entries.begin(), entries.end());
  const Matrix gram = W.transpose() * W;
  Eigen::SimplicialLDLT<Matrix> factor(gram);
  if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 1e-9 * factor.vectorD().maxCoeff()))
    throw InputError({"", 0, "sampling"},
                     "the surface samples do not see every control point; use more samples per cell");
  const Eigen::VectorXd A = Eigen::Map<const Eigen::VectorXd>(free_area.data(), free_area.size());
  Eigen::VectorXd y = factor.solve(A);
  y += factor.solve(A - gram * y);  // one refinement: the identity W^T a = A is used as exact
  const Eigen::VectorXd a = W * y;
  return {a.data(), a.data() + a.size()};
}

}  // namespace

std::vector<double> controlAreas(const Garment& garment) {
  const std::vector<int> offsets = controlOffsets(garment);
  std::vector<double> area(offsets.back(), 0);
  for (const SheetCell& cell : sheetCells(garment)) {
    const NurbsPatch& patch = garment.patches[cell.patch];
    for (const CellPoint& point : cellRule(cell, patch.u.degree + 1, patch.v.degree + 1)) {
      const SurfaceBasis basis = surfaceBasis(patch, point.u, point.v);
      Vec3 A1{}, A2{};
      for (std::size_t k = 0; k < basis.columns.size(); ++k) {
        A1 += basis.values[1][k] * patch.points[basis.columns[k]];
        A2 += basis.values[2][k] * patch.points[basis.columns[k]];
      }
      const double dA = norm(cross(A1, A2)) * point.weight;
      for (std::size_t k = 0; k < basis.columns.size(); ++k)
        area[offsets[cell.patch] + basis.columns[k]] += basis.values[0][k] * dA;
    }
  }
  return area;
}

Surface buildSurface(const Garment& garment, const FreeMap& map, int per_cell) {
  const std::vector<int> offsets = controlOffsets(garment);
  const int patch_count = static_cast<int>(garment.patches.size());
  Surface s;
  std::vector<std::vector<double>> us(patch_count), vs(patch_count);
  std::vector<int> first{0};
  for (int p = 0; p < patch_count; ++p) {
    us[p] = sampleParameters(garment.patches[p].u, per_cell);
    vs[p] = sampleParameters(garment.patches[p].v, per_cell);
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
    const auto [nua, nva] = s.patch_grid_size[seam.a.patch];
    const auto [nub, nvb] = s.patch_grid_size[seam.b.patch];
    const auto a = gridEdge(nua, nva, seam.a), b = gridEdge(nub, nvb, seam.b);
    for (std::size_t k = 0; k < a.size(); ++k) {
      const int i = find(first[seam.a.patch] + a[k]), j = find(first[seam.b.patch] + b[k]);
      if (i != j) parent[std::max(i, j)] = std::min(i, j);
    }
  }
  std::vector<int> index(first.back(), -1);
  s.W.column_count = offsets.back();
  s.patch_grid.resize(patch_count);
  for (int p = 0; p < patch_count; ++p) {
    const auto [nu, nv] = s.patch_grid_size[p];
    for (int j = 0; j < nv; ++j)
      for (int i = 0; i < nu; ++i) {
        const int raw = first[p] + i + nu * j, root = find(raw);
        if (root == raw) {
          index[raw] = s.W.rows();
          const SurfaceBasis basis = surfaceBasis(garment.patches[p], us[p][i], vs[p][j]);
          for (std::size_t k = 0; k < basis.columns.size(); ++k)
            if (basis.values[0][k] != 0) s.W.add(offsets[p] + basis.columns[k], basis.values[0][k]);
          s.W.endRow();
          s.patch.push_back(p);
          s.parameters.push_back({us[p][i], vs[p][j]});
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
      }
  }
  s.WT = multiply(s.W, map.T);
  s.WTt = transpose(s.WT);
  const std::vector<double> area = controlAreas(garment);
  std::vector<double> free_area(map.T.column_count);
  map.Tt.multiply<double>(area, free_area);
  s.area_m2 = consistentAreas(s.WT, free_area);
  for (int i = 0; i < s.size(); ++i)
    if (!(s.area_m2[i] > 0))
      throw InputError({"", 0, "sampling"},
                       "surface sample " + std::to_string(i) + " of patch " + std::to_string(s.patch[i]) + " at (" +
                           std::to_string(s.parameters[i].x) + ", " + std::to_string(s.parameters[i].y) +
                           ") would carry the area " + std::to_string(s.area_m2[i]) +
                           " m^2; choose another number of samples per cell");
  return s;
}

std::vector<int> edgeSamples(const Surface& surface, const PatchEdge& edge) {
  const auto [nu, nv] = surface.patch_grid_size[edge.patch];
  std::vector<int> at = gridEdge(nu, nv, edge);
  for (int& i : at) i = surface.patch_grid[edge.patch][i];
  return at;
}

}  // namespace gambeson
