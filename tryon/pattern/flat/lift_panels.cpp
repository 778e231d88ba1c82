#include "tryon/pattern/flat/lift_panels.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
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
constexpr double kCorners = 0.2;     ///< of what passes through as placed: corners under the arms, which slide off

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

/// By how much panels are moved in height so that their seams come together in it: the least sum over the seams of
/// length (z_a + d_a - z_b - d_b)^2, the mean of d 0.
std::vector<double> levelled(std::size_t panels, const std::vector<SeamPair>& pairs,
                             const std::function<double(int, Vec2)>& height) {
  const auto n = static_cast<Eigen::Index>(panels);
  Eigen::MatrixXd A = Eigen::MatrixXd::Constant(n, n, 1e-6);  // the mean; of parts that no seam ties each by itself
  A.diagonal().array() += 1e-9;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  for (const SeamPair& p : pairs) {
    const double off = p.length_m * (height(p.b, p.xb) - height(p.a, p.xa));
    A(p.a, p.a) += p.length_m, A(p.b, p.b) += p.length_m;
    A(p.a, p.b) -= p.length_m, A(p.b, p.a) -= p.length_m;
    b(p.a) += off, b(p.b) -= off;
  }
  const Eigen::VectorXd d = A.ldlt().solve(b);
  return {d.begin(), d.end()};
}

}  // namespace

PanelLift liftOverBody(const FlatPattern& pattern, const Vec3& position, const StandingBody& form) {
  const BodyDepth body(form);
  const std::vector<SeamPair> pairs = someOf(seamPairs(pattern));
  const auto at = [&](int panel, Vec2 x) {
    const PanelPlace& place = *pattern.panels[static_cast<std::size_t>(panel)].placement;
    return position + place.origin_m + x.x * place.along_x + x.y * place.along_y;
  };
  std::vector<double> own(pattern.panels.size(), 0.0);
  const auto through = [&](double lift) {
    std::vector<double> length(pairs.size());
    forAllUneven(Each::much, static_cast<int>(pairs.size()), [&](int k) {
      const SeamPair& p = pairs[static_cast<std::size_t>(k)];
      const auto lifted = [&](int panel, Vec2 x) {
        return at(panel, x) + Vec3{0, 0, lift + own[static_cast<std::size_t>(panel)]};
      };
      length[static_cast<std::size_t>(k)] = passes(body, lifted(p.a, p.xa), lifted(p.b, p.xb)) ? p.length_m : 0;
    });
    return std::accumulate(length.begin(), length.end(), 0.0);
  };
  PanelLift out;
  out.through_m = out.left_m = through(0);
  if (out.through_m <= kMuch_m) return out;
  own = levelled(own.size(), pairs, [&](int panel, Vec2 x) { return at(panel, x).z; });
  std::vector<double> left;
  for (int k = 0; k < kLifts; ++k) left.push_back(through(k * kLift_m));
  const double least = *std::min_element(left.begin(), left.end());
  const auto first = std::find_if(left.begin(), left.end(), [&](double l) { return l <= least + kMuch_m; });
  const auto end = std::find_if(first, left.end(), [&](double l) { return l > least + kCorners * out.through_m; });
  const auto chosen = first + std::max<std::ptrdiff_t>(end - 1 - first, 0) / 2;
  out.left_m = *chosen;
  for (const double d : own) out.panel_m.push_back(d + kLift_m * static_cast<double>(chosen - left.begin()));
  return out;
}

}  // namespace gambeson
