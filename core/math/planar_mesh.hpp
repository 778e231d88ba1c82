#pragma once
/// Triangles over a region of the plane, whose border is given by its points.

#include <array>
#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

struct PlanarMesh {
  std::vector<Vec2> points;                   ///< those of the border first, loop after loop
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise
};

/// Covers what lies within the first loop, which runs counter-clockwise, and outside of the others, which run
/// clockwise. Edges from each point of a loop to the next are edges of the mesh, and no point is added to them. Points
/// inside start on a lattice of equilateral triangles of this side, one of whose directions is x, those that lie nearer
/// than 0.6 sides to the border left out. The mesh is Delaunay's as far as the border lets it be (Lawson's flips); then
/// points inside go to the middle of their neighbours, and edges flip again. Loops of n points take O(n^2), points
/// inside some walking each. Throws InputError (key "outline") where a loop has fewer than three points, or loops cross
/// themselves or each other, and unless spacing > 0.
PlanarMesh planarMesh(std::span<const std::vector<Vec2>> loops, double spacing);

/// The smallest height of a triangle over the longest edge of it, 0.866 where it is equilateral.
double flatness(const PlanarMesh& mesh, std::size_t triangle);

}  // namespace gambeson
