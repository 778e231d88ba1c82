#pragma once
/// Which samples of a sheet lie away from its borders: stress is singular at re-entrant corners, and a border's cells
/// feel its free edge.

#include <array>
#include <span>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// Triangles of the samples; samples on joined edges are one. A cell is (patch, number) of `triangle_patch` and
/// `triangle_cell`.
struct SheetMesh {
  std::span<const std::array<int, 3>> triangles;
  std::span<const int> triangle_patch, triangle_cell;
  std::span<const Vec3> rest_m;  ///< of the samples
};

/// Samples of cells that have no free edge (a side of a triangle that no other has): 1, else 0. A strap of two cells
/// across has none.
std::vector<char> innerSamples(const SheetMesh& mesh);

/// Samples of cells that touch no re-entrant corner: a sample on the border around which the sheet at rest fills more
/// than `angle_rad` (> pi: pi is a straight border, 3 pi / 2 the inner corner of an L).
std::vector<char> clearOfCorners(const SheetMesh& mesh, double angle_rad);

/// sqrt(sum of area x^2 / sum of area) over the samples of each region.
std::vector<double> regionRms(std::span<const int> region, std::span<const double> area_m2, std::span<const double> x,
                              int regions);

}  // namespace gambeson
