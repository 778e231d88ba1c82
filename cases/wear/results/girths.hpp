#pragma once
/// Girths of the body of a scenario, and of the cloth around it, at one instant.

#include <vector>

#include "cases/wear/results/measure.hpp"

namespace gambeson {

/// Those of the human at a time, and of cloth whose samples are at `x`; none without a human.
std::vector<GirthMeasure> girthsAt(const Scenario& scenario, const std::vector<Vec3>& x, double time_s);

}  // namespace gambeson
