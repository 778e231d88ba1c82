#pragma once
/// Where contact with bodies is told apart: patches, what lies under a belt, edges on springs.

#include <vector>

#include "cases/wear/scene/scenario.hpp"

namespace gambeson {

/// Fills `contact_regions` and `contact_region` of the scenario, and with them `contact_groups` and `contact_group`.
/// `first`: the first patch of each garment; `q`: the points at the start.
void nameContactRegions(Scenario& s, const std::vector<Garment>& garments, const std::vector<int>& first,
                        const std::vector<Vec3>& q);

}  // namespace gambeson
