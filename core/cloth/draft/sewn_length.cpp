#include "core/cloth/draft/sewn_length.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/quadrature.hpp"

namespace gambeson {
namespace {

constexpr int kStations = 16;  ///< of each knot cell of a curve

/// Where the curve's own cells end between two of its parameters, in the order from one to the other.
std::vector<double> cellsOf(const SewnPart& part) {
  std::vector<double> ends{part.from};
  std::vector<double> inner;
  for (const double t : breakpoints(part.curve.knots))
    if (t > std::min(part.from, part.to) && t < std::max(part.from, part.to)) inner.push_back(t);
  if (part.from > part.to) std::reverse(inner.begin(), inner.end());
  ends.insert(ends.end(), inner.begin(), inner.end());
  ends.push_back(part.to);
  return ends;
}

}  // namespace

SewnLength::SewnLength(const Garment& garment, const SewnEdge& edge, const std::string& key)
    : garment_(garment), edge_(edge) {
  const auto reject = [&](const std::string& reason) { throw InputError({"", 0, key}, reason); };
  if (edge.empty()) reject("an edge has no parts");
  double length = 0;
  for (int k = 0; k < static_cast<int>(edge.size()); ++k) {
    const SewnPart& part = edge[static_cast<std::size_t>(k)];
    if (part.patch < 0 || part.patch >= static_cast<int>(garment.patches.size()))
      reject("patch " + std::to_string(part.patch) + " does not exist");
    validate(part.curve);
    const NurbsPatch& patch = garment.patches[static_cast<std::size_t>(part.patch)];
    const double low = part.curve.knots.front(), high = part.curve.knots.back();
    if (!(part.from >= low && part.from <= high && part.to >= low && part.to <= high && part.from != part.to))
      reject("a part of a curve runs from one of its parameters to another, within [" + std::to_string(low) + ", " +
             std::to_string(high) + "]");
    const std::vector<double> cells = cellsOf(part);
    const double start = length;
    stations_.push_back({k, part.from, length});
    for (std::size_t c = 0; c + 1 < cells.size(); ++c)
      for (int i = 0; i < kStations; ++i) {
        const auto t = [&](int j) { return cells[c] + (cells[c + 1] - cells[c]) * j / kStations; };
        const Vec2 uv = curvePoint(part.curve, t(i + 1)).point;
        const double eps = 1e-9;
        const double du = eps * (patch.u.back() - patch.u.front()), dv = eps * (patch.v.back() - patch.v.front());
        if (!(uv.x >= patch.u.front() - du && uv.x <= patch.u.back() + du && uv.y >= patch.v.front() - dv &&
              uv.y <= patch.v.back() + dv))
          reject("an edge leaves patch " + std::to_string(part.patch) + " at (" + std::to_string(uv.x) + ", " +
                 std::to_string(uv.y) + ")");
        length += lengthBetween(k, t(i), t(i + 1));
        stations_.push_back({k, t(i + 1), length});
      }
    if (!(length > start)) reject("part " + std::to_string(k) + " of an edge has no length at rest");
  }
}

SewnLength::Speed SewnLength::speed(int part, double t) const {
  const SewnPart& p = edge_[static_cast<std::size_t>(part)];
  const NurbsPatch& patch = garment_.patches[static_cast<std::size_t>(p.patch)];
  const CurvePoint c = curvePoint(p.curve, t);
  const Vec2 uv{std::clamp(c.point.x, patch.u.front(), patch.u.back()),
                std::clamp(c.point.y, patch.v.front(), patch.v.back())};
  const std::array<Vec3, 6> d = surfaceDerivatives(patch, uv.x, uv.y);
  return {uv, c.tangent, c.tangent.x * d[1] + c.tangent.y * d[2]};
}

double SewnLength::lengthBetween(int part, double from, double to) const {
  static const Quadrature rule = gaussLegendre(5);
  double length = 0;
  for (std::size_t g = 0; g < rule.points.size(); ++g)
    length += rule.weights[g] * norm(speed(part, from + rule.points[g] * (to - from)).x);
  return length * std::abs(to - from);
}

SewnPoint SewnLength::at(double fraction) const {
  const double wanted = std::clamp(fraction, 0.0, 1.0) * length_m();
  // The station before it, not the last of a part.
  auto it = std::upper_bound(stations_.begin(), stations_.end(), wanted,
                             [](double l, const Station& s) { return l < s.length_m; });
  if (it == stations_.end()) --it;  // the very end
  while (it != stations_.begin() && (it - 1)->part != it->part) ++it;
  const Station &before = *(it - 1), &after = *it;
  const double sense = after.t > before.t ? 1 : -1;
  double t = before.t;
  if (after.length_m > before.length_m)
    t += (after.t - before.t) * (wanted - before.length_m) / (after.length_m - before.length_m);
  for (int k = 0; k < 8; ++k) {
    const double missing = wanted - before.length_m - lengthBetween(before.part, before.t, t);
    if (std::abs(missing) <= 1e-14 * length_m()) break;
    const double slope = norm(speed(before.part, t).x);
    if (!(slope > 0)) break;
    t = std::clamp(t + sense * missing / slope, std::min(before.t, after.t), std::max(before.t, after.t));
  }
  const Speed s = speed(before.part, t);
  const double size = norm(s.x);
  SewnPoint point{edge_[static_cast<std::size_t>(before.part)].patch, s.uv, {}, {}, 0};
  if (!(size > 0)) return point;
  point.along = {sense * s.tangent.x / size, sense * s.tangent.y / size};
  point.tangent = (sense / size) * s.x;
  const NurbsPatch& patch = garment_.patches[static_cast<std::size_t>(point.patch)];
  const auto span = [](const KnotVector& k, double at) {
    const int i = findSpan(k, at);
    return k.knots[static_cast<std::size_t>(i + 1)] - k.knots[static_cast<std::size_t>(i)];
  };
  point.cells_per_m = std::hypot(point.along.x / span(patch.u, point.uv.x), point.along.y / span(patch.v, point.uv.y));
  return point;
}

double SewnLength::cells() const {
  constexpr int n = 64;
  double sum = 0;
  for (int k = 0; k < n; ++k) sum += at((k + 0.5) / n).cells_per_m / n;
  return sum * length_m();
}

std::vector<double> SewnLength::corners() const {
  std::vector<double> out{0};
  for (std::size_t k = 1; k < stations_.size(); ++k)
    if (stations_[k].part != stations_[k - 1].part) out.push_back(stations_[k].length_m / length_m());
  out.push_back(1);
  return out;
}

}  // namespace gambeson
