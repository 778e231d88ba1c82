#include "core/cloth/law_range.hpp"

#include <fmt/format.h>

namespace gambeson {

void LawRange::add(const LawRange& part, int patches_before) {
  points += part.points;
  beyond += part.beyond;
  unanswered += part.unanswered;
  if (first || !part.first) return;
  first = part.first;
  first->patch += patches_before;
}

std::string unansweredInWords(const LawRange& range) {
  const LawRange::Point& p = *range.first;
  const std::array<double, 3>&e = p.at.strain, &k = p.at.curvature;
  return fmt::format(
      "{} of {} points find no answer of their law, the first in patch {} at {:.3g} of its u and {:.3g} of its v, "
      "under E11 "
      "= {:.4g}, E22 = {:.4g}, 2 E12 = {:.4g} and a curvature of {:.3g}, {:.3g}, {:.3g} 1/m: {}",
      range.unanswered, range.points, p.patch, p.fraction.x, p.fraction.y, e[0], e[1], e[2], k[0], k[1], k[2], p.why);
}

}  // namespace gambeson
