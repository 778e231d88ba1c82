#pragma once
/// Stress and strain of a NURBS sheet as pictures and tables show them.
///
/// The strain of a thin sheet of quadratic cells that bends swings within each cell about the true membrane strain, by
/// (curvature times cell)^2: times a membrane's stiffness that is far more than the stress. The mean over a cell, taken
/// at the points of the cell's own rule, is what balances the loads. So patches of degree 2 show these means,
/// interpolated between the middles of cells and carried on to the border with the slope of the last two; what is
/// bilinear in the parameters is reproduced, as far as means show it (not along a single cell). Under assumed strains
/// (core/cloth/shell/assumed.hpp) the mean is over the corners, where these are tied.
/// Cut cells, and patches of other degrees, take stress and strain where they are asked.

#include <span>
#include <utility>
#include <vector>

#include "core/cloth/draft/cells.hpp"
#include "core/cloth/shell/shell.hpp"
#include "core/cloth/stress.hpp"

namespace gambeson {

class StressField : public StressView {
 public:
  explicit StressField(const Shell& shell);

  std::size_t cells() const override { return cells_.size(); }
  std::vector<Sample> means(const ClothState& state, const More& more) const override;
  PrincipalStress at(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means,
                     const More& more) const override;
  PlaneTensor strainAt(const ClothState& state, int patch, Vec2 uv, std::span<const Sample> means) const override;

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
  Sample sampleAt(std::span<const Vec3> q, int patch, Vec2 uv, const More& more) const;
  /// The sum of what the cells at a place show there, and of how many.
  std::pair<Sample, int> shownAt(std::span<const Vec3> q, int patch, Vec2 uv, std::span<const Sample> means,
                                 const More& more) const;
  Sample meanOf(std::span<const Vec3> q, const Cell& cell, const More& more) const;

  const Shell& shell_;
  std::vector<Grid> grids_;  ///< of patches
  std::vector<Cell> cells_;
};

}  // namespace gambeson
