#include "core/material/hysteresis.hpp"

#include <fmt/format.h>

#include "core/material/laws/zheng_bending.hpp"

namespace gambeson {

VirginCurve curveOver(double b1, double b2, double span) {
  if (!(b2 >= 0 && b1 > b2))
    throw InputError({}, fmt::format("b1 = {} and b2 = {} N m are not allowed: b1 > b2 >= 0", b1, b2));
  if (!(span > 0 && std::isfinite(span))) throw InputError({}, fmt::format("K0 = {} 1/m is not allowed: > 0", span));
  return {[=](double k) { return k * (b1 - 0.5 * (b1 - b2) * k / span); },
          [=](double k) { return b1 - (b1 - b2) * std::min(k / span, 1.0); },
          span,
          {}};
}

VirginCurve quadraticCurve(double b1, double b2, double c1) {
  if (!(c1 < 0)) throw InputError({}, fmt::format("c1 = {} N m^2 is not allowed: < 0", c1));
  return curveOver(b1, b2, (b2 - b1) / (2 * c1));
}

VirginCurve zhengVirginCurve(double b0, double k0, double kr) {
  const auto at = [=](double k) {
    Answer<double, 1> out{};
    zhengCurve<all_parts>(b0, k0, kr, k, out);
    return out;
  };
  return {[=](double k) { return at(k).resultant[0]; }, [=](double k) { return at(k).slope[0]; }, k0, {}};
}

VirginCurve measuredCurve(const std::vector<std::pair<double, double>>& points) {
  std::vector<double> k{0}, m{0}, slopes;
  for (const auto& [curvature, moment] : points) {
    if (curvature == 0 && moment == 0 && k.size() == 1) continue;
    const double slope = (moment - m.back()) / (curvature - k.back());
    if (!(curvature > k.back() && moment > m.back() && std::isfinite(slope)))
      throw InputError({}, fmt::format("({} 1/m, {} N) does not rise above the point before it", curvature, moment));
    if (!slopes.empty() && !(slope <= slopes.back()))
      throw InputError({}, fmt::format("the curve is steeper towards ({} 1/m, {} N) than before: it must be concave",
                                       curvature, moment));
    k.push_back(curvature);
    m.push_back(moment);
    slopes.push_back(slope);
  }
  if (slopes.size() < 2) throw InputError({}, "a curve needs two points or more beside (0, 0)");
  // Segment that starts at or before a curvature; the last goes on for ever.
  const auto segment = [k](double x) {
    const auto last = static_cast<std::ptrdiff_t>(k.size()) - 2;
    return static_cast<std::size_t>(
        std::clamp(std::upper_bound(k.begin(), k.end(), x) - k.begin() - 1, std::ptrdiff_t{0}, last));
  };
  const double span = k[k.size() - 2];
  return {[=](double x) { return m[segment(x)] + slopes[segment(x)] * (x - k[segment(x)]); },
          [=](double x) { return slopes[segment(x)]; },
          span,
          {k.begin() + 1, k.end() - 1}};
}

}  // namespace gambeson
