#include "human/body/bridged_folds.hpp"

#include <algorithm>
#include <cmath>

#include "core/math/parallel.hpp"
#include "human/body/skin.hpp"

namespace gambeson {

void bridge(const BridgedFolds& folds, const Skin& skin, std::span<const Pose> X_WL, double time_s, std::span<Vec3> x) {
  if (folds.empty()) return;
  const int last = static_cast<int>(folds.way.size()) - 1;
  const double s = std::clamp((time_s - folds.begin_s) / folds.every_s, 0.0, static_cast<double>(last));
  const int i = std::min(static_cast<int>(s), std::max(0, last - 1));
  const double u = s - i;
  const auto at = [&](int instant) -> const std::vector<Vec3>& {
    return folds.way[static_cast<std::size_t>(std::clamp(instant, 0, last))];
  };
  const std::vector<Vec3>&before = at(i - 1), &a = at(i), &b = at(i + 1), &after = at(i + 2);
  // Cubic Hermite, h = 1, with rates (d_{i+1} - d_{i-1})/2.
  const double h00 = (1 + 2 * u) * (1 - u) * (1 - u), h10 = u * (1 - u) * (1 - u), h01 = u * u * (3 - 2 * u),
               h11 = u * u * (u - 1);
  forAll(Each::value, static_cast<int>(folds.vertex.size()), [&](int k) {
    const auto c = static_cast<std::size_t>(k);
    const int v = folds.vertex[c];
    x[v] += X_WL[skin.segment[v]].rotation *
            (h00 * a[c] + (0.5 * h10) * (b[c] - before[c]) + h01 * b[c] + (0.5 * h11) * (after[c] - a[c]));
  });
}

}  // namespace gambeson
