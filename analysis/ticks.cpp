#include "analysis/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gambeson {
namespace {

std::string withMinus(std::string s) {
  if (s.find_first_of("123456789") == std::string::npos && !s.empty() && s[0] == '-') s.erase(0, 1);  // -0.00
  if (const auto at = s.find('-'); at == 0) s.replace(0, 1, "\u2212");
  return s;
}

}  // namespace

std::string Ticks::label(double value) const {
  const double size = std::max(
      {std::abs(value), std::abs(values.empty() ? 0 : values.front()), std::abs(values.empty() ? 0 : values.back())});
  if (step < 1e-4 || size >= 1e6) {
    if (std::abs(value) < step / 2) return "0";
    const auto magnitude = [](double v) { return static_cast<int>(std::floor(std::log10(v) + 1e-9)); };
    const int power = magnitude(std::abs(value)), decimals = std::clamp(power - magnitude(step), 0, 6);
    return withMinus(fmt::format("{:.{}f}", value / std::pow(10.0, power), decimals)) + "e" +
           withMinus(fmt::format("{}", power));
  }
  const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
  return withMinus(fmt::format("{:.{}f}", value, decimals));
}

Ticks niceTicks(double low, double high, int target) {
  assert(std::isfinite(low) && std::isfinite(high) && low < high && target >= 1);
  const double rough = (high - low) / target;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / power;
  // Bounds are the geometric means of the neighbours 1, 2, 5, 10.
  const double nice = lead < std::sqrt(2.0) ? 1 : lead < std::sqrt(10.0) ? 2 : lead < std::sqrt(50.0) ? 5 : 10;
  Ticks ticks;
  ticks.step = nice * power;
  // A millionth of a step takes up the rounding of low / step: the ends belong to the range.
  const double first = std::ceil(low / ticks.step - 1e-6), last = std::floor(high / ticks.step + 1e-6);
  for (double k = first; k <= last; ++k) ticks.values.push_back(k * ticks.step + 0.0);
  return ticks;
}

Ticks ticksThatFit(double low, double high, int target, double length, double per_character) {
  for (;; --target) {
    Ticks ticks = niceTicks(low, high, target);
    std::size_t widest = 0;
    for (const double v : ticks.values) {
      std::size_t characters = 0;
      for (const char c : ticks.label(v)) characters += (c & 0xC0) != 0x80;  // of UTF-8, without continuations
      widest = std::max(widest, characters);
    }
    const double apart = ticks.step / (high - low) * length;
    if (target == 1 || apart >= per_character * static_cast<double>(widest + 1)) return ticks;
  }
}

std::string formatNumber(double value, int digits) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value > 0 ? "infinite" : "\u2212infinite";
  if (value == 0) return "0";
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value)) + 1e-12));
  if (magnitude < -4 || magnitude >= 6) {
    const double mantissa = value / std::pow(10.0, magnitude);
    return withMinus(fmt::format("{:.{}f}", mantissa, std::max(0, digits - 1))) + "e" +
           withMinus(fmt::format("{}", magnitude));
  }
  const int decimals = digits - 1 - magnitude;
  if (decimals >= 0) return withMinus(fmt::format("{:.{}f}", value, decimals));
  const double unit = std::pow(10.0, -decimals);
  return withMinus(fmt::format("{:.0f}", std::round(value / unit) * unit));
}

std::string formatBrief(double value, int digits) {
  std::string s = formatNumber(value, digits);
  if (s.find('.') == std::string::npos) return s;
  while (s.back() == '0') s.pop_back();
  if (s.back() == '.') s.pop_back();
  return s;
}

double roundedUp(double value) {
  if (!(value > 0)) return 0;
  const double ten = std::pow(10, std::floor(std::log10(value)));
  for (const double n : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (value <= n * ten * (1 + 1e-12)) return n * ten;
  return 10 * ten;
}

}  // namespace gambeson
