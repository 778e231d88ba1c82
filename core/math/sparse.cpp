#include "core/math/sparse.hpp"

#include <algorithm>
#include <map>

namespace gambeson {

Vec3 combine(const std::vector<int>& columns, const std::vector<double>& row, std::span<const Vec3> q) {
  Vec3 sum{};
  for (std::size_t k = 0; k < columns.size(); ++k) sum += row[k] * q[columns[k]];
  return sum;
}

SparseRows transpose(const SparseRows& a) {
  SparseRows t;
  t.column_count = a.rows();
  t.offsets.assign(a.column_count + 1, 0);
  for (int c : a.columns) ++t.offsets[c + 1];
  for (int c = 0; c < a.column_count; ++c) t.offsets[c + 1] += t.offsets[c];
  t.columns.resize(a.columns.size());
  t.values.resize(a.values.size());
  std::vector<int> next(t.offsets.begin(), t.offsets.end() - 1);
  for (int r = 0; r < a.rows(); ++r)
    for (int k = a.offsets[r]; k < a.offsets[r + 1]; ++k) {
      const int at = next[a.columns[k]]++;
      t.columns[at] = r;
      t.values[at] = a.values[k];
    }
  return t;
}

SparseRows multiply(const SparseRows& a, const SparseRows& b) {
  SparseRows c;
  c.column_count = b.column_count;
  for (int r = 0; r < a.rows(); ++r) {
    std::map<int, double> row;
    for (int k = a.offsets[r]; k < a.offsets[r + 1]; ++k)
      for (int j = b.offsets[a.columns[k]]; j < b.offsets[a.columns[k] + 1]; ++j)
        row[b.columns[j]] += a.values[k] * b.values[j];
    for (const auto& [column, value] : row)
      if (value != 0) c.add(column, value);
    c.endRow();
  }
  return c;
}

SparseRows identityRows(int n) {
  SparseRows i;
  i.column_count = n;
  for (int r = 0; r < n; ++r) {
    i.add(r, 1.0);
    i.endRow();
  }
  return i;
}

}  // namespace gambeson
