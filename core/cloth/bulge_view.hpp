#pragma once
/// Bulges (bulge.hpp) by where their arrays lie, on a host or a device.

#include <algorithm>
#include <array>

#include "core/cloth/bulge.hpp"

namespace gambeson {

struct RowsView {
  const int* offsets = nullptr;
  const int* columns = nullptr;
  const double* values = nullptr;
};

struct BulgesView {
  RowsView middle, of_sample;
  const std::array<int, 2>* ends = nullptr;

  /// As Bulges::at and Bulges::beside have it.
  GAMBESON_HD Vec3 at(int row, const Vec3* x) const {
    Vec3 out{};
    for (int k = middle.offsets[row]; k < middle.offsets[row + 1]; ++k) out += middle.values[k] * x[middle.columns[k]];
    return out;
  }
  GAMBESON_HD double beside(int sample, const Vec3& direction, const Vec3* x, bool across = true) const {
    double most = 0;
    for (int e = of_sample.offsets[sample]; e < of_sample.offsets[sample + 1]; ++e) {
      if (!across && of_sample.values[e] == 0) continue;
      const int row = of_sample.columns[e];
      double out = 0;
      for (int k = middle.offsets[row]; k < middle.offsets[row + 1]; ++k)
        out += middle.values[k] * dot(x[middle.columns[k]], direction);
      most = std::max(most, out);
    }
    return most;
  }
};

inline BulgesView viewOf(const Bulges& b) {
  const auto rows = [](const SparseRows& r) { return RowsView{r.offsets.data(), r.columns.data(), r.values.data()}; };
  return {rows(b.middle), rows(b.of_sample), b.ends.data()};
}

}  // namespace gambeson
