#pragma once
/// Triangles over what trimming leaves of a patch, with the loops as their outline.

#include <array>
#include <span>
#include <vector>

#include "core/nurbs/trim.hpp"

namespace gambeson {

struct TrimMesh {
  std::vector<Vec2> uv;
  std::vector<int> grid;                      ///< the vertex of each point of the grid us x vs (u fastest), or -1
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise in (u, v)
};

/// Whole cells of the grid are halved as everywhere (alternating diagonals). Cut ones become polygons, divided by
/// cutting off the corner with the largest smallest angle (Zheng 2013, section 2.4). Then edges shorter than 0.3 of the
/// grid's spacing shrink to a point (a grid sample near the outline moves onto it), and edges flip where that widens
/// the smallest angle. `fixed_sides` (u0, u1, v0, v1): points on these sides stay, other patches share them.
TrimMesh trimMesh(const NurbsPatch& patch, const Trim& trim, std::span<const double> us, std::span<const double> vs,
                  std::array<bool, 4> fixed_sides = {});

}  // namespace gambeson
