#pragma once
/// Cells of a shell whose law is an energy at a point (a table, a cell of yarns), cell by cell and without lanes.

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "core/cloth/cloth_state.hpp"
#include "core/cloth/draft/cells.hpp"
#include "core/cloth/draft/garment.hpp"
#include "core/cloth/law_range.hpp"
#include "core/material/point_energy.hpp"

namespace gambeson {

/// Where the cells of a block write, as the kernels do: cell k is lane k % lanes of group k / lanes.
struct BlockLayout {
  int lanes = 1;
  long history_first = 0;         ///< of the block in the cloth's history
  std::vector<long> first_point;  ///< of each group, counted in points of all lanes
};

/// Kinematics and quadrature points are those of the kernels (shell_tangent.kernel.cpp says the formulas). The same
/// bits for any number of threads.
class PointCells {
 public:
  /// `rule`: Gauss points along u and v of whole cells; cut cells have their own. `offsets`: of the patches among all
  /// control points. `of_shape`: curvatures count from the shape at rest.
  PointCells(const Garment& garment, const std::vector<int>& offsets, const std::vector<SheetCell>& cells,
             std::array<int, 2> rule, BlockLayout layout, std::shared_ptr<const PointEnergy> energy, bool of_shape);

  const PointEnergy& energy() const { return *energy_; }
  void setHistory(long first) { layout_.history_first = first; }

  /// Writes f_int of the cells to `slots`, [group][node][3][lane], what the points would remember where `out` asks for
  /// it, and adds the energy that it asks for.
  void force(const ClothState& state, const ClothForce& out, const ForceTerms& terms, const StrainBox& within,
             double* slots) const;
  /// Writes d2E/dq2 of the cells of the groups [first, first + count): [group - first][pair][9][lane], as the kernels.
  void tangent(const ClothState& state, const ForceTerms& terms, int first, int count, double* pairs) const;
  LawRange range(const ClothState& state) const;
  StrainBox strains(const ClothState& state) const;

 private:
  struct Point {
    std::vector<std::array<double, 5>> shapes;  ///< of each node: N,1 N,2 N,11 N,22 N,12 along weft and warp
    double area_m2 = 0;
    int patch = 0;
    Vec2 fraction;                           ///< of the patch's range of parameters
    std::array<double, 3> rest_curvature{};  ///< k11, k22, 2 k12 [1/m]
  };
  struct Cell {
    std::vector<int> nodes;
    std::vector<Point> points;
  };
  struct Deformed;
  struct Work;

  Deformed deformed(const Cell& cell, const Point& point, std::span<const Vec3> q) const;
  /// What the points of a cell answer, with what the terms leave out, or by the steepest slopes; the first `remembered`
  /// doubles of the work.
  void answer(std::size_t cell, const ClothState& state, const ForceTerms& terms, SheetParts parts, bool remember,
              const std::array<double, 36>& steepest, Work& work) const;
  /// The place in the cloth's history of the first number of a point.
  long historyOf(std::size_t cell, std::size_t point) const;

  std::vector<Cell> cells_;
  BlockLayout layout_;
  std::shared_ptr<const PointEnergy> energy_;
};

}  // namespace gambeson
