#pragma once
/// The sheet that the benchmarks measure.

#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson::bench {

enum class Knots {
  uneven_rational,   ///< weights uneven too, so that every cell is rational
  uneven_polynomial  ///< weights 1
};

/// A wavy sheet of 1 m of soft armour (Zheng 2013, section 6.2), `cells` each way. Knots are uneven, so that nothing is
/// uniform. `solid`: the consistent section in place of armour's bending law.
Garment wavySheet(int degree, int cells, bool solid, Knots knots);

/// Its control points displaced, so that strains are not zero.
std::vector<Vec3> displaced(const Garment& sheet);

}  // namespace gambeson::bench
