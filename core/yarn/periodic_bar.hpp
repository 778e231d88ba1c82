#pragma once
/// Homogenisation where it has a closed form: a bar of periodic stiffness (Man 2006, section 4.2.1, eqs. 4.13 to 4.32).

#include <vector>

namespace gambeson {

/// One period, of pieces of constant stiffness.
struct PeriodicBar {
  std::vector<double> length;    ///< of the pieces, in any unit, > 0
  std::vector<double> young_Pa;  ///< E(y) there, > 0
};

struct HomogenisedBar {
  std::vector<double> characteristic;  ///< chi at the ends of the pieces, first and last 0; unit of the lengths
  double young_Pa = 0;                 ///< the mean of E (1 + dchi/dy), eq. 4.32
};

/// Solves d/dy [E (1 + dchi/dy)] = 0 (eq. 4.29), chi periodic, by linear elements, one a piece: exact at their ends.
/// The closed form is the harmonic mean, Y/(integral of dy/E). Throws InputError, keys "length" and "young", where a
/// number is not positive or there are not as many of both, at least one.
HomogenisedBar homogenise(const PeriodicBar& bar);

}  // namespace gambeson
