#include "core/cloth/bulge.hpp"

#include <algorithm>

namespace gambeson {

double Bulges::beside(int sample, const Vec3& direction, std::span<const Vec3> x, bool across) const {
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

}  // namespace gambeson
