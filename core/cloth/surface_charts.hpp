#pragma once
/// The triangles of a surface in the grids of its samples, as the contact tree takes them.

#include <span>
#include <vector>

#include "core/cloth/surface.hpp"
#include "core/contact/contact_tree.hpp"

namespace gambeson {

struct SurfaceCharts {
  std::vector<GridChart> charts;      ///< of each patch
  std::vector<ChartCorners> corners;  ///< of each triangle; of cells that are not whole they mean nothing
};

/// Reference coordinates are mean lengths along the grid lines at the positions `rest` of the samples, so that a cloth
/// without strain has gradients near rotations.
SurfaceCharts surfaceCharts(const Surface& surface, std::span<const Vec3> rest);

}  // namespace gambeson
