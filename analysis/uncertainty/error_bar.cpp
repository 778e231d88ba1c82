#include "analysis/uncertainty/error_bar.hpp"

#include <cmath>

namespace gambeson {

std::optional<double> ErrorBar::of(BarPart part) const {
  switch (part) {
    case BarPart::mesh:
      return mesh;
    case BarPart::step:
      return step;
    case BarPart::fabric:
      return fabric;
    default:
      return {};
  }
}

std::optional<double> ErrorBar::combined() const {
  double sum = 0;
  bool any = false;
  for (const BarPart part : kBarParts)
    if (const auto one = of(part)) sum += *one * *one, any = true;
  return any ? std::optional(std::sqrt(sum)) : std::nullopt;
}

BarPart ErrorBar::largest() const {
  BarPart most = BarPart::none;
  for (const BarPart part : kBarParts)
    if (of(part).value_or(0) > of(most).value_or(0)) most = part;
  return most;
}

double ErrorBar::share(BarPart part) const {
  const double whole = combined().value_or(0), one = of(part).value_or(0);
  return whole > 0 ? one * one / (whole * whole) : 0;
}

std::string_view nameOf(BarPart part) {
  constexpr std::array<std::string_view, 4> names{"none", "mesh", "step", "fabric"};
  return names[static_cast<std::size_t>(part)];
}

double gridBar(double difference, double ratio, double order, double safety, About about) {
  const double r = std::pow(ratio, order);
  return safety * difference * (about == About::coarse ? r : 1) / (r - 1);
}

double meshBar(double difference, int coarse_points, int fine_points, About about) {
  constexpr double order = 2, safety = 1.25;
  return gridBar(difference, std::sqrt(double(fine_points) / coarse_points), order, safety, about);
}

double stepBar(double difference) {
  constexpr double order = 1, safety = 1.25;
  return gridBar(difference, 2, order, safety, About::coarse);
}

}  // namespace gambeson
