#include "core/yarn/cell_friction.hpp"

#include <cmath>

#include "core/yarn/rod_cell.hpp"

namespace gambeson {

CellFriction frictionAt(const RodCell& cell, const CellFaces& faces, std::span<const Pose> sections,
                        const CellHistory& history) {
  CellFriction now{history.grips, {}};
  for (const PairGrip& g : history.grips) now.normal_N.push_back(cell.pairAt(faces, sections, g.pair).normal_N);
  return now;
}

void accept(const RodCell& cell, const CellFaces& faces, std::span<const Pose> sections, CellHistory& history) {
  const RodFriction& law = cell.design().friction;
  std::vector<PairGrip> next;
  history.stored_J = 0;
  std::size_t g = 0;
  const std::vector<PairGrip>& last = history.grips;
  for (int k = 0; k < cell.pairs(); ++k) {
    const bool held = g < last.size() && last[g].pair == k;
    const RodCell::PairPlace pair = cell.pairAt(faces, sections, k);
    Vec3 slip{};
    if (held) {
      const auto& aside = last[g].aside_m;
      slip = slipOf(last[g].grip, movedAside(pair.first, aside[0]), movedAside(pair.second, aside[1])).slip;
      const double k_N_per_m = law.stick_stiffness_N_per_m3 * pair.lengths_m2, r = norm(slip);
      const double most = law.coefficient * pair.normal_N / k_N_per_m;
      if (r > most) {
        history.lost_J += 0.5 * law.coefficient * (last[g].normal_N + pair.normal_N) * (r - most);
        slip *= most / r;
      }
      history.stored_J += 0.5 * k_N_per_m * norm2(slip);
      ++g;
    }
    if (!(pair.normal_N > 0)) continue;
    const auto& aside = pair.aside_m;
    next.push_back({k, gripBetween(movedAside(pair.first, aside[0]), movedAside(pair.second, aside[1]), slip), aside,
                    pair.normal_N});
  }
  history.grips.swap(next);
}

}  // namespace gambeson
