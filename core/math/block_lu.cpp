#include "core/math/block_lu.hpp"

#include <Eigen/LU>
#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace gambeson {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Sparse graphOf(int size, std::span<const int> offsets, std::span<const int> members) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, 1.0);
  for (std::size_t g = 0; g + 1 < offsets.size(); ++g)
    for (int a = offsets[g]; a < offsets[g + 1]; ++a)
      for (int b = offsets[g]; b < offsets[g + 1]; ++b) entries.emplace_back(members[a], members[b], 1.0);
  Sparse graph(size, size);
  graph.setFromTriplets(entries.begin(), entries.end());
  return graph;
}

Eigen::Vector3d eigen(const Vec3& v) { return {v.x, v.y, v.z}; }
Vec3 vec3(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

}  // namespace

BlockLu::BlockLu(int size, std::span<const int> offsets, std::span<const int> members) : place_(size), offsets_{0} {
  const Sparse graph = graphOf(size, offsets, members);
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(graph, order);
  for (int k = 0; k < size; ++k) place_[order.indices()[k]] = k;
  // Column j of L has what A has below the diagonal and what the columns have that j is the first row of.
  std::vector<std::vector<int>> children(size);
  std::vector<int> seen(size, -1);
  for (int j = 0; j < size; ++j) {
    seen[j] = j;
    const auto take = [&](int row) {
      if (row <= j || seen[row] == j) return;
      seen[row] = j;
      rows_.push_back(row);
    };
    for (Sparse::InnerIterator at(graph, order.indices()[j]); at; ++at) take(place_[at.row()]);
    for (int child : children[j])
      for (int k = offsets_[child]; k < offsets_[child + 1]; ++k) take(rows_[k]);
    std::sort(rows_.begin() + offsets_[j], rows_.end());
    offsets_.push_back(static_cast<int>(rows_.size()));
    if (offsets_[j] < offsets_[j + 1]) children[rows_[offsets_[j]]].push_back(j);
  }
  lower_.resize(rows_.size());
  upper_.resize(rows_.size());
  diagonal_.resize(size);
}

void BlockLu::clear() {
  for (auto* blocks : {&lower_, &upper_, &diagonal_})
    std::fill(blocks->begin(), blocks->end(), Eigen::Matrix3d::Zero());
}

void BlockLu::add(int row, int column, const Eigen::Matrix3d& block) {
  const int i = place_[row], j = place_[column], first = std::min(i, j);
  if (i == j) {
    diagonal_[i] += block;
    return;
  }
  const auto begin = rows_.begin() + offsets_[first], end = rows_.begin() + offsets_[first + 1];
  const auto at = std::lower_bound(begin, end, std::max(i, j)) - rows_.begin();
  (i > j ? lower_ : upper_)[at] += block;
}

bool BlockLu::factorise() {
  for (std::size_t j = 0; j < diagonal_.size(); ++j) {
    Eigen::Matrix3d inverse;
    bool invertible = false;
    diagonal_[j].computeInverseWithCheck(inverse, invertible, 0.0);
    if (!invertible || !inverse.allFinite()) return false;
    diagonal_[j] = inverse;
    const int begin = offsets_[j], end = offsets_[j + 1];
    for (int a = begin; a < end; ++a) lower_[a] = lower_[a] * inverse;
    for (int a = begin; a < end; ++a) {
      const int k = rows_[a];
      diagonal_[k].noalias() -= lower_[a] * upper_[a];
      int at = offsets_[k];  // what is below row k in column j is in column k too
      for (int b = a + 1; b < end; ++b) {
        while (rows_[at] != rows_[b]) ++at;
        lower_[at].noalias() -= lower_[b] * upper_[a];
        upper_[at].noalias() -= lower_[a] * upper_[b];
      }
    }
  }
  return true;
}

void BlockLu::solve(std::span<Vec3> x) const {
  const int n = static_cast<int>(diagonal_.size());
  std::vector<Eigen::Vector3d> y(n);
  for (int i = 0; i < n; ++i) y[place_[i]] = eigen(x[i]);
  for (int j = 0; j < n; ++j)
    for (int k = offsets_[j]; k < offsets_[j + 1]; ++k) y[rows_[k]].noalias() -= lower_[k] * y[j];
  for (int j = n - 1; j >= 0; --j) {
    for (int k = offsets_[j]; k < offsets_[j + 1]; ++k) y[j].noalias() -= upper_[k] * y[rows_[k]];
    y[j] = (diagonal_[j] * y[j]).eval();
  }
  for (int i = 0; i < n; ++i) x[i] = vec3(y[place_[i]]);
}

}  // namespace gambeson
