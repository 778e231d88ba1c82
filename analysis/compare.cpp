#include "analysis/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace gambeson {
namespace {

bool positive(double x) { return x > 0 && std::isfinite(x); }

}  // namespace

std::optional<PowerLaw> fitPowerLaw(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size() || x.size() < 2) return {};
  std::vector<std::pair<double, double>> points;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!positive(x[i]) || !positive(y[i])) return {};
    points.emplace_back(std::log(x[i]), std::log(y[i]));
  }
  std::sort(points.begin(), points.end());
  const double n = static_cast<double>(points.size());
  double mx = 0, my = 0, xx = 0, xy = 0;
  for (const auto& [a, b] : points) mx += a / n, my += b / n;
  for (const auto& [a, b] : points) xx += (a - mx) * (a - mx), xy += (a - mx) * (b - my);
  if (!(xx > 0)) return {};
  PowerLaw law;
  law.points = static_cast<int>(points.size());
  law.exponent = xy / xx;
  double rest = 0;
  for (const auto& [a, b] : points) rest += std::pow(b - my - law.exponent * (a - mx), 2);
  law.standard_error = points.size() > 2 ? std::sqrt(rest / (n - 2) / xx) : std::nan("");
  law.lowest = std::numeric_limits<double>::infinity();
  law.highest = -law.lowest;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double dx = points[i + 1].first - points[i].first;
    if (!(dx > 0)) continue;
    const double slope = (points[i + 1].second - points[i].second) / dx;
    law.lowest = std::min(law.lowest, slope);
    law.highest = std::max(law.highest, slope);
  }
  return law;
}

std::optional<double> elasticity(double low, double high, double y_low, double y_high) {
  if (!positive(low) || !positive(high) || low == high || !positive(y_low) || !positive(y_high)) return {};
  return std::log(y_high / y_low) / std::log(high / low);
}

std::optional<double> Elasticities::sum() const {
  if (!complete()) return {};
  return *bending + *membrane + *weight + *inertia + *drag;
}

std::optional<double> Elasticities::thicknessExponent() const {
  if (!bending || !membrane || !weight || !inertia) return {};
  return *membrane + *weight + *inertia + 3 * *bending;
}

Light lightOf(std::optional<double> part, double green, double red) {
  if (!part || !std::isfinite(*part)) return Light::unknown;
  return *part < green ? Light::green : *part > red ? Light::red : Light::amber;
}

const char* nameOf(Light light) {
  switch (light) {
    case Light::green:
      return "green";
    case Light::doubtful:
      return "doubtful";
    case Light::amber:
      return "amber";
    case Light::red:
      return "red";
    case Light::unknown:
      break;
  }
  return "not known";
}

Light lightNamed(const std::string& name) {
  for (const Light light : {Light::green, Light::doubtful, Light::amber, Light::red})
    if (name == nameOf(light)) return light;
  return Light::unknown;
}

}  // namespace gambeson
