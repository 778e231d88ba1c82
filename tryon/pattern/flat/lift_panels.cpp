#include "tryon/pattern/flat/lift_panels.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "core/math/parallel.hpp"
#include "tryon/pattern/flat/body_depth.hpp"
#include "tryon/pattern/flat/lay_panels.hpp"

namespace gambeson {
namespace {

constexpr double kLift_m = 0.01;     ///< steps
constexpr int kLifts = 26;           ///< with the one as placed
constexpr double kSpacing_m = 0.01;  ///< of points on a line that are looked at, at least
constexpr double kFar_m = 0.1;       ///< and at most, where the body is far
constexpr double kSeam_m = 0.02;     ///< of seam that each line stands for
constexpr double kMuch_m = 0.02;     ///< of seam

/// Whether the line from a to b, its ends too, passes through the body.
bool passes(const BodyDepth& body, const Vec3& a, const Vec3& b) {
  const double length = norm(b - a);
  for (double s = 0; s < length;) {
    const double depth = body.at(a + (s / length) * (b - a)).depth_m;
    if (depth > 0) return true;
    s += std::max(kSpacing_m, std::min(-depth, kFar_m));
  }
  return body.at(b).depth_m > 0;
}

/// Pairs of two panels, some 2 cm of seam each.
std::vector<SeamPair> someOf(const std::vector<SeamPair>& pairs) {
  std::vector<SeamPair> out;
  double length = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (pairs[k].a == pairs[k].b) continue;  // darts
    length += pairs[k].length_m;
    const bool ends = k + 1 == pairs.size() || pairs[k + 1].a != pairs[k].a || pairs[k + 1].b != pairs[k].b;
    if (length < kSeam_m && !ends) continue;
    out.push_back(pairs[k]);
    out.back().length_m = std::exchange(length, 0);
  }
  return out;
}

}  // namespace

PanelLift liftOverBody(const FlatPattern& pattern, const Vec3& position, const StandingBody& form) {
  const BodyDepth body(form);
  const std::vector<SeamPair> pairs = someOf(seamPairs(pattern));
  const auto at = [&](int panel, Vec2 x) {
    const PanelPlace& place = *pattern.panels[static_cast<std::size_t>(panel)].placement;
    return position + place.origin_m + x.x * place.along_x + x.y * place.along_y;
  };
  const auto through = [&](double lift) {
    std::vector<double> length(pairs.size());
    forAllUneven(Each::much, static_cast<int>(pairs.size()), [&](int k) {
      const SeamPair& p = pairs[static_cast<std::size_t>(k)];
      const Vec3 up{0, 0, lift};
      length[static_cast<std::size_t>(k)] = passes(body, at(p.a, p.xa) + up, at(p.b, p.xb) + up) ? p.length_m : 0;
    });
    return std::accumulate(length.begin(), length.end(), 0.0);
  };
  PanelLift out;
  out.through_m = out.left_m = through(0);
  if (out.through_m <= kMuch_m) return out;
  std::vector<double> left{out.through_m};
  for (int k = 1; k < kLifts; ++k) left.push_back(through(k * kLift_m));
  const double least = *std::min_element(left.begin(), left.end());
  const auto first = std::find_if(left.begin(), left.end(), [&](double l) { return l <= least + kMuch_m; });
  out.lift_m = kLift_m * static_cast<double>(first - left.begin());
  out.left_m = *first;
  return out;
}

}  // namespace gambeson
