#pragma once
/// Masses for cloth whose threads are limited.

#include <vector>

#include "core/cloth/draft/areas.hpp"
#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// As controlMasses, but that no control point that trimming has left a sliver of bears less than `share` of what it
/// bears untrimmed; the others of its patch bear as much less, so that the patch's mass stays [kg]. A thread under
/// tension swings such a point at (tension/mass)^1/2, which falls to zero faster than what the thread has of it: two
/// points at a neckline, with 0.7 % of the mean mass, asked for steps five times shorter than all others.
std::vector<double> evenedMasses(const Garment& garment, double share);

}  // namespace gambeson
