#include "human/body/bridged_folds.hpp"

#include <algorithm>
#include <array>

#include "core/math/parallel.hpp"
#include "human/body/skin.hpp"

namespace gambeson {

void bridge(const BridgedFolds& folds, const Skin& skin, std::span<const Pose> X_WL, double time_s, std::span<Vec3> x) {
  if (folds.empty()) return;
  const int last = static_cast<int>(folds.first.size()) - 2;
  const double s = std::clamp((time_s - folds.begin_s) / folds.every_s, 0.0, static_cast<double>(last));
  const int i = std::min(static_cast<int>(s), std::max(0, last - 1));
  const double u = s - i;
  // Cubic Hermite, h = 1, with rates (d_{i+1} - d_{i-1})/2.
  const double h00 = (1 + 2 * u) * (1 - u) * (1 - u), h10 = u * (1 - u) * (1 - u), h01 = u * u * (3 - 2 * u),
               h11 = u * u * (u - 1);
  const std::array<double, 4> share = {-0.5 * h10, h00 - 0.5 * h11, h01 + 0.5 * h10, 0.5 * h11};
  for (int j = 0; j < 4; ++j) {
    const int instant = std::clamp(i - 1 + j, 0, last), begin = folds.first[instant];
    forAll(Each::value, folds.first[instant + 1] - begin, [&](int k) {
      const int v = folds.vertex[begin + k];
      x[v] += X_WL[skin.segment[v]].rotation * (share[j] * folds.way[begin + k]);
    });
  }
}

}  // namespace gambeson
