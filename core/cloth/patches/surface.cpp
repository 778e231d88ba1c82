#include "core/cloth/patches/surface.hpp"
#include "core/cloth/draft/areas.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/grid_lines.hpp"
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

using Matrix = Eigen::SparseMatrix<double>;

Matrix matrixOf(const SparseRows& WT) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < WT.rows(); ++r)
    for (int k = WT.offsets[r]; k < WT.offsets[r + 1]; ++k) entries.emplace_back(r, WT.columns[k], WT.values[k]);
  Matrix W(WT.rows(), WT.column_count);
  W.setFromTriplets(entries.begin(), entries.end());
  return W;
}

/// The smallest a with WTᵀ a = A.
std::vector<double> consistentAreas(const SparseRows& WT, const std::vector<double>& free_area) {
  const Matrix W = matrixOf(WT);
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

/// The a with WTᵀ a = A that is nearest to g > 0 in the sense of least sum a log(a/g) - a, always positive:
/// a = g exp(WT y), with y from Newton on the convex dual sum g exp(WT y) - A y. Its first step is the minimum of
/// sum (a - g)^2 / g.
std::vector<double> positiveAreas(const SparseRows& WT, const std::vector<double>& free_area,
                                  const Eigen::VectorXd& g) {
  const Matrix W = matrixOf(WT);
  const Eigen::VectorXd A = Eigen::Map<const Eigen::VectorXd>(free_area.data(), free_area.size());
  Eigen::VectorXd a = g;
  Eigen::SimplicialLDLT<Matrix> factor;
  const double small = 1e-14 * A.maxCoeff();
  for (int k = 0; k < 100; ++k) {
    const Eigen::VectorXd left = A - W.transpose() * a;
    if (left.cwiseAbs().maxCoeff() <= small) return {a.data(), a.data() + a.size()};
    const Matrix hessian = W.transpose() * a.asDiagonal() * W;
    if (k == 0) factor.analyzePattern(hessian);
    factor.factorize(hessian);
    if (factor.info() != Eigen::Success || !(factor.vectorD().minCoeff() > 1e-12 * factor.vectorD().maxCoeff()))
      throw InputError({"", 0, "sampling"},
                       "the surface samples do not see every control point; use more samples per cell");
    const Eigen::VectorXd step = factor.solve(left), move = W * step;
    // No area changes more than e-fold in a step; then halve until the dual does not rise.
    double scale = std::min(1.0, 1 / std::max(1e-300, move.cwiseAbs().maxCoeff()));
    const double slope = left.dot(step);
    for (int halvings = 0;; ++halvings, scale *= 0.5) {
      const Eigen::VectorXd next = (a.array() * (scale * move).array().exp()).matrix();
      const double change = (next - a).sum() - scale * A.dot(step);
      if (change <= -1e-4 * scale * slope || halvings == 40 || slope <= 1e-13 * A.sum()) {
        a = next;
        break;
      }
    }
  }
  const double error = (A - W.transpose() * a).cwiseAbs().maxCoeff();
  if (error <= 1e3 * small) return {a.data(), a.data() + a.size()};
  throw InputError(
      {"", 0, "sampling"},
      "no positive areas of the surface samples stand for the cloth; use another number of samples per cell");
}

/// A third of the rest area of the triangles at each sample.
Eigen::VectorXd tributaryAreas(const Garment& garment, const Surface& s) {
  std::vector<Vec3> Q, X(s.W.rows());
  for (const NurbsPatch& p : garment.patches) Q.insert(Q.end(), p.points.begin(), p.points.end());
  s.W.multiply<Vec3>(Q, X);
  Eigen::VectorXd area = Eigen::VectorXd::Zero(s.W.rows());
  for (const auto& [a, b, c] : s.triangles)
    for (int i : {a, b, c}) area(i) += norm(cross(X[b] - X[a], X[c] - X[a])) / 6;
  return area;
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
  const std::vector<int> offsets = controlOffsets(garment);
  const int patch_count = static_cast<int>(garment.patches.size());
  if (per_cell.size() != garment.patches.size())
    throw InputError({"", 0, "sampling"}, "one number of samples per cell for each patch is needed");
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
  bool trimmed = false;
  s.W.column_count = offsets.back();
  s.patch_grid.resize(patch_count);
  s.edge_samples.resize(patch_count);
  for (int p = 0; p < patch_count; ++p) {
    const auto [nu, nv] = s.patch_grid_size[p];
    if (isTrimmed(garment, p)) {
      trimmed = true;
      const TrimMesh mesh = trimMesh(garment.patches[p], garment.trims[p], us[p], vs[p], joinedSides(garment, p));
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
  const std::vector<double> area = controlAreas(garment);
  std::vector<double> free_area(map.T.column_count);
  map.Tt.multiply<double>(area, free_area);
  // The minimum norm turns negative beside slivers.
  s.area_m2 = trimmed ? positiveAreas(s.WT, free_area, tributaryAreas(garment, s)) : consistentAreas(s.WT, free_area);
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

}  // namespace gambeson
