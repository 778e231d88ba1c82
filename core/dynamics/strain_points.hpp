#pragma once
/// Where strain is limited: the points, their strains as functions of the free points, and the stress that the
/// multipliers stand for (Zheng 2013, sections 5.4 and 5.5).

#include <array>
#include <span>
#include <vector>

#include "core/math/cholesky.hpp"
#include "core/math/sparse.hpp"
#include "core/sheet/garment.hpp"
#include "core/sheet/seams.hpp"

namespace gambeson {

/// A constraint point: a vertex of the knot mesh, or a crossing of a trimming loop with a knot line (section 5.4).
struct StrainPoint {
  int patch = 0;
  Vec2 uv;
  double area_m2 = 0;  ///< of rest surface that it stands for; all points together have that of the garment
};

/// Two strains per point: row 2 i is along the weft, 2 i + 1 along the warp, the physical directions D at rest. With
/// F D = B p, linear in the free points p, the Green-Lagrange strain is E = (|B p|^2 - 1)/2, its gradient
/// dE/dp_k = b_k F D, and with w_k = 1/m_k (0 where held)
///   (J M^-1 J^T)_ij = S_ij (F D_i . F D_j),   S_ij = sum_k b_ik b_jk w_k:
/// the pattern and S are constant. Entries of a row of B sum to 0: no force of a strain moves the whole.
struct StrainRows {
  std::vector<StrainPoint> points;
  SparseRows B;   ///< [1/m]
  SparseRows Bt;  ///< its transpose
  /// S on and below the diagonal [1/(kg m^2)]. Rows that no free point changes are alone with a diagonal of 1.
  SymmetricMatrix S;
  std::vector<char> live;  ///< of each row: whether a free point changes it

  /// Knot lines of a patch, and what stands at their crossings and in their cells. All indices run u fastest.
  struct Grid {
    std::vector<double> us, vs;
    int first_vertex = 0;  ///< of the patch in the rows of vertex_of_cell
  };
  std::vector<Grid> grids;
  SparseRows cell_of_point;   ///< resultants of the cells [N/m] from multipliers per point [J]
  SparseRows vertex_of_cell;  ///< field at the vertices from the cells

  int rows() const { return B.rows(); }
};

/// Points on joined edges are one, with the strains of the first patch that holds them. On trimmed patches vertices
/// outside are left out, and crossings of loops with knot lines are added unless they lie within 5 % of a cell of
/// another point, whose strain says the same.
StrainRows buildStrainRows(const Garment& garment, const FreeMap& map, std::span<const double> inverse_mass);

/// F D of all rows.
void strainVectors(const StrainRows& rows, std::span<const Vec3> p, std::vector<Vec3>& e);
/// (|F D|^2 - 1)/2.
inline double strainOf(const Vec3& e) { return 0.5 * (norm2(e) - 1); }

/// Eq. 5.23: the resultants (n_weft, n_warp) [N/m], second Piola-Kirchhoff, that go with the multipliers of the rows
/// (in the mean of a step) [J], at the vertices of all patches. A multiplier over its area alternates from point to
/// point, since the sums over points do not integrate exactly. So each cell takes its share of the multipliers of its
/// corners over its area (that is its one Gauss point), which keeps the integral, and the field is extended from the
/// cells to the vertices: mean of four inside, fitted plane at borders. A linear field is kept exactly.
std::vector<Vec2> limitStress(const StrainRows& rows, std::span<const double> multiplier_J);
/// The field of limitStress at a point of a patch, bilinear in each cell.
Vec2 limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv);

}  // namespace gambeson
