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
  double area_m2 = 0;            ///< of rest surface that it stands for; all points together have that of the garment
  std::array<int, 2> row{0, 0};  ///< of the strains along weft and warp; several points may share one
};

/// What impulses i do to the free points: v = P i with P = C (C^T M C)^-1 C^T, u = C y the motions that supports leave.
struct Mobility {
  std::vector<double> inverse_mass;  ///< P = diag(w, w, w) of each point, 0 where it is held; else empty
  SparseRows P;                      ///< supports that hold components or couple points: 3 rows and columns a point
};
/// v = P i.
void applyMobility(const Mobility& mobility, std::span<const Vec3> impulse, std::span<Vec3> velocity);

/// Two strains per point, along the weft and the warp, the physical directions D at rest. With F D = B p, linear in the
/// free points p, the Green-Lagrange strain is E = (|B p|^2 - 1)/2, its gradient dE/dp_k = b_k F D, and
///   (J M^-1 J^T)_ij = F D_i . S_ij F D_j,   S_ij = sum_kl b_ik P_kl b_jl:
/// the pattern and S are constant. Entries of a row of B sum to 0: no force of a strain moves the whole. Where all
/// points are whole, S_ij is a number times the identity.
struct StrainRows {
  std::vector<StrainPoint> points;
  SparseRows B;                 ///< [1/m]
  SparseRows Bt;                ///< its transpose
  std::vector<double> area_m2;  ///< of each row: of the points that share it together
  Mobility mobility;
  /// S on and below the diagonal [1/(kg m^2)], a third of its trace where it is a tensor. Rows that no free point
  /// changes are alone with a diagonal of 1.
  SymmetricMatrix S;
  std::vector<std::array<double, 9>> tensors;  ///< S_rc of the entries, by rows; empty where S is numbers
  std::vector<char> live;                      ///< of each row: whether a free point changes it

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

/// Each patch has the strains of its own vertices, so that both sides of a seam are held: across a C0 seam they differ.
/// Strains that are the same function of the free points (along a seam; all of a G1 seam whose threads run on) are one
/// row, and points that share both rows are one. On trimmed patches vertices
/// outside are left out, and crossings of loops with knot lines are added unless they lie within 5 % of a cell of
/// another point, whose strain says the same.
StrainRows buildStrainRows(const Garment& garment, const FreeMap& map, Mobility mobility);

/// F D of all rows.
void strainVectors(const StrainRows& rows, std::span<const Vec3> p, std::vector<Vec3>& e);
/// (|F D|^2 - 1)/2.
inline double strainOf(const Vec3& e) { return 0.5 * (norm2(e) - 1); }

/// Eq. 5.23: the resultants (n_weft, n_warp) [N/m], second Piola-Kirchhoff, that go with the multipliers of the rows
/// (in the mean of a step) [J], at the vertices of all patches. A multiplier over its area alternates from point to
/// point, since the sums over points do not integrate exactly. So each cell takes its share of the multipliers of its
/// corners over its area (that is its one Gauss point; points that share a row have it by their areas), which keeps the
/// integral, and the field is extended from the cells to the vertices: mean of four inside, fitted plane at borders. A
/// linear field is kept exactly.
std::vector<Vec2> limitStress(const StrainRows& rows, std::span<const double> multiplier_J);
/// The field of limitStress at a point of a patch, bilinear in each cell.
Vec2 limitStressAt(const StrainRows& rows, std::span<const Vec2> field, int patch, Vec2 uv);

}  // namespace gambeson
