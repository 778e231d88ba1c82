#pragma once
/// Measures of a person that contradict each other.

#include <string>
#include <vector>

#include "human/manikin/measures.hpp"

namespace gambeson {

/// A measure that goes with no body of the stature and mass given, and the range of those that do [m, kg].
struct OddMeasure {
  std::string key;  ///< mass, inseam, chest, waist or hip
  double value = 0, least = 0, most = 0;
};

/// Measures that contradict each other: a mass whose body-mass index is outside 14 to 50 kg/m² (alone: then regressions
/// say nothing of the others), a girth further from its regression than 6 standard errors, an inseam further than 4.
std::vector<OddMeasure> oddMeasures(const ManikinMeasures& measures);

}  // namespace gambeson
