#pragma once
/// Between a scenario and a dressed state: what is worn, put on and taken down.

#include "cases/wear/scene/dressed.hpp"
#include "cases/wear/scene/scenario.hpp"

namespace gambeson {

/// The scenario starts with the garments as dressed. Throws InputError where these are other garments or another body.
void wear(Scenario& scenario, const Dressed& dressed);

/// Where the control points are.
std::vector<Vec3> controlPoints(const Scenario& scenario, const State& state);

/// What is worn now, at a time up to 0.
Dressed dressedOf(const Scenario& scenario, const State& state);

}  // namespace gambeson
