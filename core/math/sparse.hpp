#pragma once
/// Sparse rows with a stored transpose, so that products with either are gathers in a fixed order.

#include <span>
#include <vector>

#include "core/math/parallel.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Compressed sparse rows. Row r holds columns[k], values[k] for offsets[r] <= k < offsets[r + 1].
struct SparseRows {
  int column_count = 0;
  std::vector<int> offsets{0};
  std::vector<int> columns;
  std::vector<double> values;

  int rows() const { return static_cast<int>(offsets.size()) - 1; }
  /// Appends an entry to the row that `endRow` closes.
  void add(int column, double value) {
    columns.push_back(column);
    values.push_back(value);
  }
  void endRow() { offsets.push_back(static_cast<int>(columns.size())); }

  /// y = A x, row by row in a fixed order.
  template <class T>
  void multiply(std::span<const T> x, std::span<T> y) const {
    forAll(Each::sum, rows(), [&](int r) {
      T sum{};
      for (int k = offsets[r]; k < offsets[r + 1]; ++k) sum += values[k] * x[columns[k]];
      y[r] = sum;
    });
  }
};

/// sum_k row[k] q[columns[k]].
Vec3 combine(const std::vector<int>& columns, const std::vector<double>& row, std::span<const Vec3> q);

SparseRows transpose(const SparseRows& a);
/// The product A B; entries of a row in ascending column order, exact zeros dropped.
SparseRows multiply(const SparseRows& a, const SparseRows& b);
SparseRows identityRows(int n);

}  // namespace gambeson
