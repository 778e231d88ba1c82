#pragma once
/// Between a scenario and a dressed state: what is worn, put on and taken down.

#include "cases/wear/scene/dressed.hpp"
#include "cases/wear/scene/scenario.hpp"

namespace gambeson {

/// The scenario starts with the garments as dressed, with what their laws remember unless the case wipes it. Throws
/// InputError where these are other garments or another body.
void wear(Scenario& scenario, const Dressed& dressed);

/// Where the control points are.
std::vector<Vec3> controlPoints(const Scenario& scenario, const State& state);

/// What the laws of a garment remember, patch by patch, by place: an order that does not depend on what else is worn.
std::vector<double> historyOf(const Cloth& cloth, std::span<const double> history, int garment);
/// Writes it back. Returns how many numbers are of the garment; where `of_garment` has others, nothing is written.
std::size_t setHistoryOf(const Cloth& cloth, int garment, std::span<const double> of_garment,
                         std::span<double> history);

/// What the laws of a cloth remember, on another cloth of the same garments; new where that has places of its own
/// (hinges of seams).
std::vector<double> carriedHistory(const Cloth& from, std::span<const double> history, const Cloth& to);

/// What is worn now, at a time up to 0.
Dressed dressedOf(const Scenario& scenario, const State& state);

}  // namespace gambeson
