#pragma once
/// Girths of the body of a scenario, and of the cloth around it, at one instant.

#include <string>
#include <vector>

#include "cases/wear/results/measure.hpp"

namespace gambeson {

/// Those of the human at a time, and of cloth whose samples are at `x`; none without a human.
std::vector<GirthMeasure> girthsAt(const Scenario& scenario, const std::vector<Vec3>& x, double time_s);

/// "garment "shirt" does not fit: at a height of 1.47 m it is 34.7 cm around and worn 37.4 cm: 2.7 cm short".
std::string doesNotFit(const ShortMeasure& garment);

}  // namespace gambeson
