#pragma once
/// What area and mass of a draft each control point stands for.

#include <vector>

#include "core/cloth/draft/garment.hpp"

namespace gambeson {

/// ∫ N dA at rest for each control point [m^2].
std::vector<double> controlAreas(const Garment& garment);
/// ∫ rho N dA with the surface density of each point [kg].
std::vector<double> controlMasses(const Garment& garment);

}  // namespace gambeson
