#pragma once
/// Where strain is limited: the strains as functions of the free points, and the stress that the multipliers stand for
/// (Zheng 2013, sections 5.4 and 5.5).

#include <array>
#include <span>
#include <vector>

#include "core/math/cholesky.hpp"
#include "core/math/sparse.hpp"
#include "core/math/vec.hpp"

namespace gambeson {

/// Where threads are constrained.
///
/// vertices: of the knot mesh, weft and warp, and crossings of trimming loops with knot lines (Zheng 2013,
/// section 5.4). For n x n quadratic cells that is n + 1 points across a thread, and n + 2 control points: the motion
/// along the thread of 0, 1, -1, 1, ..., 0 times control points across it, any function along it, strains no thread at
/// any vertex (to first order). What loads do on it the fabric alone carries, its shear above all. A load that is
/// uniform across does h (1/3) on it where n is odd, 0 where n is even (there by symmetry alone: any load that is not
/// symmetric works on it for even n too). So the patch test of section 5.6.4 on 7 x 7 cells: soft cloth is strained by
/// +-0.9 % at the middles of the loaded cells, what it hands on to the threads by shear stays as a stress 5 to 8 % low
/// in the border's vertices and 1 % high in the next. Multipliers over areas also alternate, 4/3, 2/3, 4/3. Of degree p
/// there are p - 1 such motions: cubic 4 x 4 cells are up to 8 % off in that test.
///
/// threads: each strain at the Greville points of the splines that it lies in, those of the derivative along the thread
/// (the vertices, for smooth quadratics) and those of the patch across it. As many points as coefficients: no motion of
/// that kind is left and none is held twice, multipliers over areas are the stress without alternation on any number of
/// cells. Asks for whole, smooth patches of degree 2 or more whose threads follow their knot lines.
///
/// gauss, centres: 2 x 2 Gauss points a cell, or one; for comparison. Zheng 2013, section 5.4, rejects both: 8 strains
/// a cell against 3 coordinates of a control point lock, since a quadratic cell cannot bend and keep the length of that
/// many threads; one point a cell does not see control points that move to and fro from one to the next along the
/// thread (hourglass). For whole patches.
enum class LimitPoints { vertices, threads, gauss, centres };

/// A constraint point.
struct StrainPoint {
  int patch = 0;
  Vec2 uv;
  double area_m2 = 0;  ///< of rest surface that it stands for; all of a thread together have that of the garment
  std::array<int, 2> row{
      0, 0};  ///< of the strains along weft and warp, -1 where it has none; several points may share one
};

/// What impulses i do to the free points: v = P i with P = C (C^T M C)^-1 C^T, u = C y the motions that supports leave.
struct Mobility {
  std::vector<double> inverse_mass;  ///< P = diag(w, w, w) of each point, 0 where it is held; else empty
  SparseRows P;                      ///< supports that hold components or couple points: 3 rows and columns a point
};
/// v = P i.
void applyMobility(const Mobility& mobility, std::span<const Vec3> impulse, std::span<Vec3> velocity);

/// Strains along the weft and the warp, the physical directions D at rest. With F D = B p, linear in the
/// free points p, the Green-Lagrange strain is E = (|B p|^2 - 1)/2, its gradient dE/dp_k = b_k F D, and
///   (J M^-1 J^T)_ij = F D_i . S_ij F D_j,   S_ij = sum_kl b_ik P_kl b_jl:
/// the sparsity and S are constant. Entries of a row of B sum to 0: no force of a strain moves the whole. Where all
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
    int first_vertex = 0;  ///< of the patch in the field
  };
  std::vector<Grid> grids;
  /// Resultants of weft and warp at the vertices of all patches [N/m] from multipliers of rows [J].
  std::array<SparseRows, 2> field_of_row;

  std::vector<StrainRows> parts;  ///< of a cloth that is made of several: what each has of its own, but for S

  int rows() const { return B.rows(); }
};

/// Completes rows whose points, B, area_m2, mobility and fields are there: the transpose, S and what is live.
void completeRows(StrainRows& rows);

/// F D of all rows.
void strainVectors(const StrainRows& rows, std::span<const Vec3> p, std::vector<Vec3>& e);
/// (|F D|^2 - 1)/2.
inline double strainOf(const Vec3& e) { return 0.5 * (norm2(e) - 1); }

/// The field of resultants (n_weft, n_warp) [N/m], second Piola-Kirchhoff, that go with the multipliers of the rows (in
/// the mean of a step) [J], eq. 5.23.
std::vector<Vec2> limitStress(const StrainRows& rows, std::span<const double> multiplier_J);

}  // namespace gambeson
