#pragma once
/// Distances along a mesh.

#include <vector>

#include "core/contact/obstacle.hpp"

namespace gambeson {

/// The length of the shortest way along edges from the nearest of `sources` to each vertex [m] (Dijkstra 1959);
/// infinite where there is none. It overestimates the distance on the surface by up to some 15 %, as ways along edges
/// do.
std::vector<double> distancesFrom(const TriangleMesh& mesh, const std::vector<int>& sources);

}  // namespace gambeson
