#pragma once
/// Sparse rows on a device: 32 rows of a slice side by side, entry after entry.

#include <algorithm>
#include <span>
#include <vector>

#include "core/math/sparse.hpp"
#include "gpu/forces/point4.hpp"

namespace gambeson::gpu {

/// out = row . in of points, in the order of the entries; a row has its own length, and nothing is padded with sums.
struct SlicedView {
  const int *first, *length;  ///< of each slice: its first entry; of each row: its entries
  const int* column;
  const double* value;
  GAMBESON_HD Point4 times(int row, const Point4* in) const {
    Vec3 sum{};
    const int at = first[row >> 5] + (row & 31);
    for (int k = 0; k < length[row]; ++k) sum = fma(value[at + 32 * k], vec(in[column[at + 32 * k]]), sum);
    return {sum.x, sum.y, sum.z, 0.0};
  }
};

template <class Device>
class SlicedRows {
 public:
  SlicedRows() = default;
  SlicedRows(typename Device::Queue& queue, const SparseRows& rows) : rows_(rows.rows()) {
    std::vector<int> first, length(static_cast<std::size_t>(rows_)), column;
    std::vector<double> value;
    for (int begin = 0; begin < rows_; begin += 32) {
      const int end = std::min(begin + 32, rows_);
      first.push_back(static_cast<int>(column.size()));
      int longest = 0;
      for (int r = begin; r < end; ++r) {
        length[static_cast<std::size_t>(r)] = rows.offsets[r + 1] - rows.offsets[r];
        longest = std::max(longest, length[static_cast<std::size_t>(r)]);
      }
      const std::size_t at = column.size();
      column.resize(at + 32 * static_cast<std::size_t>(longest));
      value.resize(column.size());
      for (int r = begin; r < end; ++r)
        for (int k = 0; k < length[static_cast<std::size_t>(r)]; ++k) {
          const std::size_t to = at + static_cast<std::size_t>(r - begin + 32 * k);
          column[to] = rows.columns[rows.offsets[r] + k];
          value[to] = rows.values[rows.offsets[r] + k];
        }
    }
    const auto put = [&](const auto& from, auto& to) {
      to = std::decay_t<decltype(to)>(from.size());
      queue.upload(std::span(from), to);
    };
    put(first, first_);
    put(length, length_);
    put(column, column_);
    put(value, value_);
  }
  int rows() const { return rows_; }
  SlicedView view() const { return {first_.data(), length_.data(), column_.data(), value_.data()}; }

 private:
  int rows_ = 0;
  typename Device::template Buffer<int> first_, length_, column_;
  typename Device::template Buffer<double> value_;
};

/// to[i] = row i . from; what `to` has as its fourth number stays.
struct MapPoints {
  SlicedView rows;
  const Point4* from;
  Point4* to;
  GAMBESON_HD void operator()(int i) const {
    const Point4 x = rows.times(i, from);
    to[i].x = x.x, to[i].y = x.y, to[i].z = x.z;
  }
};

}  // namespace gambeson::gpu
