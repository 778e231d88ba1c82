#include "core/statics/program.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"

namespace gambeson {

double Program::operator()(double t) const {
  if (t <= at.front()) return value.front();
  if (t >= at.back()) return value.back();
  const std::size_t k = static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), t) - at.begin());
  return value[k - 1] + (value[k] - value[k - 1]) * (t - at[k - 1]) / (at[k] - at[k - 1]);
}

double Program::extended(double t) const {
  const double low = std::min(0.0, at.front()), high = std::max(1.0, at.back());
  const auto slope = [&](double from, double to) { return ((*this)(to) - (*this)(from)) / (to - from); };
  // Inside the first or last piece, whose end lies at `low` or `high`, or the flat beyond it.
  double inner_low = high, inner_high = low;
  for (double a : at) {
    if (a > low) inner_low = std::min(inner_low, a);
    if (a < high) inner_high = std::max(inner_high, a);
  }
  if (t < low) return (*this)(low) + slope(low, inner_low) * (t - low);
  if (t > high) return (*this)(high) + slope(inner_high, high) * (t - high);
  return (*this)(t);
}

void checkPrograms(std::span<const Program> programs) {
  for (std::size_t k = 0; k < programs.size(); ++k) {
    const Program& p = programs[k];
    const auto reject = [&](const char* why) { throw InputError({"", 0, "programs[" + std::to_string(k) + "]"}, why); };
    if (p.at.empty() || p.at.size() != p.value.size()) reject("needs as many values as points, at least one");
    for (std::size_t i = 0; i < p.at.size(); ++i) {
      if (!std::isfinite(p.at[i]) || !std::isfinite(p.value[i])) reject("is not finite");
      if (i > 0 && !(p.at[i] > p.at[i - 1])) reject("points must ascend");
    }
  }
}

}  // namespace gambeson
