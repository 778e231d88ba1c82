#include "analysis/trust.hpp"

#include <fmt/format.h>

#include "analysis/ticks.hpp"

namespace gambeson {

std::string sentenceOf(const Stretch& s) {
  // As many digits as tell what was reached from what is allowed.
  int digits = 2;
  while (digits < 5 && s.largest != s.limit && formatBrief(s.largest, digits) == formatBrief(s.limit, digits)) ++digits;
  const auto percent = [&](double part) { return formatBrief(100 * part, digits) + " %"; };
  const std::string whose = s.garment.empty() ? "Fabric" : fmt::format("The fabric of {}", s.garment);
  return fmt::format("{} stretches by up to {}{} (99 % of it by less than {}), and {} is meant for less than {}: {}.",
                     whose, percent(s.largest), s.along.empty() ? "" : " along its " + s.along, percent(s.most),
                     s.stated ? "it" : "its law", percent(s.limit),
                     s.stated ? "it may not come back, or tear" : "beyond that its stress is extrapolated");
}

const Stretch* worstOf(std::span<const Stretch> all) {
  const Stretch* worst = nullptr;
  for (const Stretch& s : all)
    if (!worst || !(s.largest / s.limit <= worst->largest / worst->limit)) worst = &s;
  return worst;
}

Light shownLight(Light by_number, const Trust& trust) {
  if (trust.spoiling > 0) return Light::unknown;
  return by_number == Light::green && !trust.whole() ? Light::doubtful : by_number;
}

}  // namespace gambeson
