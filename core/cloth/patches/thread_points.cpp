#include "core/cloth/patches/thread_points.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <string>

#include "core/cloth/draft/cells.hpp"
#include "core/error.hpp"

namespace gambeson {
namespace {

[[noreturn]] void refuse(int patch, const std::string& why) {
  throw InputError({"", 0, "strain_limit.points"}, "threads: patch " + std::to_string(patch) + " " + why);
}

/// Largest sine of the angle between a direction of the parameters and the line that it should follow.
double offLine(const Threads& t, const Vec2& along, bool along_u) {
  const double u = std::abs(along.x) * norm(t.A1), v = std::abs(along.y) * norm(t.A2);
  return (along_u ? v : u) / std::max(u, v);
}

}  // namespace

KnotVector derivativeKnots(const KnotVector& k) { return {k.degree - 1, {k.knots.begin() + 1, k.knots.end() - 1}}; }

GrevilleRule grevilleRule(const KnotVector& k) {
  GrevilleRule rule{grevillePoints(k), {}};
  const int n = k.count(), p = k.degree;
  for (int i = 1; i < n; ++i)
    if (!(rule.at[i] - rule.at[i - 1] > 1e-9 * (k.back() - k.front())))
      throw InputError({"", 0, ""}, "has a line where its derivative jumps");
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(n, n);  // function a at point i
  Eigen::VectorXd integral(n);
  std::vector<double> values(p + 1);
  for (int i = 0; i < n; ++i) {
    const int span = findSpan(k, rule.at[i]);
    basisDerivatives(k, span, rule.at[i], 0, values);
    for (int a = 0; a <= p; ++a) N(span - p + a, i) = values[a];
    integral(i) = (k.knots[i + p + 1] - k.knots[i]) / (p + 1);
  }
  const Eigen::VectorXd w = N.partialPivLu().solve(integral);
  for (int i = 0; i < n; ++i) {
    if (!(w(i) > 0)) throw InputError({"", 0, ""}, "has knots too uneven for points of its threads");
    rule.weight.push_back(w(i));
  }
  return rule;
}

std::array<ThreadGrid, 2> threadGrids(const Garment& g, const FreeMap& map, int patch_index) {
  const NurbsPatch& patch = g.patches[patch_index];
  if (isTrimmed(g, patch_index)) refuse(patch_index, "is trimmed; use vertices");
  if (patch.u.degree < 2 || patch.v.degree < 2) refuse(patch_index, "is of degree 1; use vertices");
  const int offset = controlOffsets(g)[patch_index];
  std::array<bool, 2> weft_follows{true, true};  // u, v
  for (double v : grevillePoints(patch.v))
    for (double u : grevillePoints(patch.u)) {
      const Threads t = rowsAt(g, map, offset, patch_index, {u, v}).threads;
      for (int line = 0; line < 2; ++line)
        weft_follows[line] = weft_follows[line] && offLine(t, t.along_weft, line == 0) < 0.01 &&
                             offLine(t, t.along_warp, line == 1) < 0.01;
    }
  if (!weft_follows[0] && !weft_follows[1]) refuse(patch_index, "has threads across its knot lines; use vertices");
  try {
    const ThreadGrid along_u{grevilleRule(derivativeKnots(patch.u)), grevilleRule(patch.v)},
        along_v{grevilleRule(patch.u), grevilleRule(derivativeKnots(patch.v))};
    return weft_follows[0] ? std::array{along_u, along_v} : std::array{along_v, along_u};
  } catch (const InputError& e) {
    refuse(patch_index, e.reason() + "; use vertices");
  }
}

}  // namespace gambeson
