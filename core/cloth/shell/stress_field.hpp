#pragma once
/// Stress and strain as pictures and tables show them.
///
/// The strain of a thin sheet of quadratic cells that bends swings within each cell about the true membrane strain, by
/// (curvature times cell)^2: times a membrane's stiffness that is far more than the stress. The mean over a cell, taken
/// at the points of the cell's own rule, is what balances the loads. So patches of degree 2 show these means,
/// interpolated between the middles of cells and carried on to the border with the slope of the last two; what is
/// bilinear in the parameters is reproduced, as far as means show it (not along a single cell). Under assumed strains
/// (core/cloth/shell/assumed.hpp) the mean is over the corners, where these are tied.
/// Cut cells, and patches of other degrees, take stress and strain where they are asked.

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "core/cloth/shell/cells.hpp"
#include "core/cloth/shell/shell.hpp"

namespace gambeson {

/// Symmetric, in the basis (weft, warp) of the rest surface, the weft not turned by a fibre angle: so it is continuous
/// where that is not.
struct PlaneTensor {
  double t11 = 0, t22 = 0, t12 = 0;
};

class StressField {
 public:
  /// Keeps no hold of the shell.
  explicit StressField(const Shell& shell);

  /// What is added to the second Piola-Kirchhoff resultants along weft and warp at a place (by strain limits).
  using More = std::function<Vec2(int patch, Vec2 uv)>;

  /// True (Cauchy) resultants, turned back with the sheet's rotation, and Green-Lagrange strains.
  struct Sample {
    PlaneTensor stress, strain;
  };
  /// The means of all cells in a state, for `at`.
  std::vector<Sample> means(const Shell& shell, std::span<const Vec3> q, const More& more = {}) const;
  /// At a place; where `means` are empty those that are needed are taken.
  ShellStress at(const Shell& shell, std::span<const Vec3> q, int patch, Vec2 uv, std::span<const Sample> means,
                 const More& more = {}) const;
  /// Green-Lagrange strain along the fabric's weft and warp, and between them, of the same means.
  PlaneTensor strainAt(const Shell& shell, std::span<const Vec3> q, int patch, Vec2 uv,
                       std::span<const Sample> means) const;

 private:
  struct Grid {
    std::vector<double> u, v;  ///< ends of cells
    std::vector<int> cell;     ///< of each cell, u fastest: its number, or kOutside (trimmed away), or kHere
  };
  static constexpr int kOutside = -1, kHere = -2;

  struct Point {
    Vec2 uv;
    double weight;  ///< sum 1 in a cell
  };
  struct Cell {
    int patch;
    std::vector<Point> points;
  };
  static Sample sampleAt(const Shell& shell, std::span<const Vec3> q, int patch, Vec2 uv, const More& more);
  /// The sum of what the cells at a place show there, and of how many.
  std::pair<Sample, int> shownAt(const Shell& shell, std::span<const Vec3> q, int patch, Vec2 uv,
                                 std::span<const Sample> means, const More& more) const;
  Sample meanOf(const Shell& shell, std::span<const Vec3> q, const Cell& cell, const More& more) const;

  std::vector<Grid> grids_;  ///< of patches
  std::vector<Cell> cells_;
};

}  // namespace gambeson
