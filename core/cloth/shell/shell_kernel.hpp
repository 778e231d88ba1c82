#pragma once
/// The element kernel of the Kirchhoff-Love shell: data as the kernels want it, and the choice of instruction set.
/// One lane of a vector is one cell; a group is as many cells as the vector has lanes.

#include <span>
#include <string>
#include <vector>

#include "core/material/section.hpp"
#include "core/math/aligned.hpp"

namespace gambeson {

/// The general law at a point: n = A e + B k, m = B e + D k (core/material/section.hpp), with eq. 2.14 for the moments
/// of weft and warp where kappa0 > 0 (B0 in D11 and D22, the twist rigidity in D33), with the membrane relaxed to its
/// tension field where `tension` is not 0, and jamming (core/material/jamming.hpp) with `jam_N_per_m` below the square
/// `jam_s` of an area ratio.
struct PointLaw {
  Section section;
  double kappa0 = 0, kappa_regular = 0;
  double tension = 0;
  double jam_N_per_m = 0, jam_s = 0;
};
constexpr int kShareDoubles = 33;  ///< of the ties at a Gauss point, and of the correction of the mean
constexpr int kMeanDoubles = 75;   ///< of a cell's correction of the mean
constexpr int kMaxTies = 8;        ///< Gauss points per direction of a cell with assumed strains
constexpr int kLawDoubles =
    23;  ///< A, B, D, kappa0, kappa_regular, tension, jam_N_per_m, jam_s: a PointLaw as the kernels read it
static_assert(sizeof(PointLaw) == kLawDoubles * sizeof(double));

/// Cells of one degree pair and one quadrature rule, packed for vectors of `lanes` doubles. All arrays run
/// [group][...][lane]; a last group is filled up with copies of a cell whose area is zero.
/// A block of cut cells (`scattered`) holds the derivatives of the (rational) basis at each point instead of their
/// factors; its groups differ in the number of points.
struct ShellBlock {
  int lanes = 1, groups = 0;
  int p = 2, q = 2;    ///< degrees along u and v
  int gu = 3, gv = 3;  ///< quadrature points along u and v
  bool rational = false;
  bool scattered = false;
  AlignedVector<int> nodes;       ///< [group][(p+1)(q+1)][lane] control point, u fastest
  AlignedVector<double> weights;  ///< [group][(p+1)(q+1)][lane], rational blocks only
  AlignedVector<double> basis_u;  ///< [group][gu][3][p+1][lane]: B-spline values, first and second derivatives
  AlignedVector<double> basis_v;  ///< [group][gv][3][q+1][lane]
  std::vector<long> first_point;  ///< scattered: of each group, and the end
  AlignedVector<double> shapes;   ///< scattered: [point][5][(p+1)(q+1)][lane]: N,1 N,2 N,11 N,22 N,12
  AlignedVector<double>
      points;  ///< [group][gv][gu][pointDoubles()][lane]: G11 G12 G21 G22 dA (w w1 w2 w11 w22 w12) (k11 k22 k12)
  bool rest_curvature = false;  ///< whether the rest curvature (physical components) is subtracted
  /// Assumed strains (core/cloth/shell/assumed.hpp; p = q = 2, not scattered): basis at the two knots of the cell,
  /// [group][2][2][degree + 1][lane] values and first derivatives; shares of the ties at the Gauss points,
  /// [point][kShareDoubles][lane]; covariant rest metric at the ties (A11, A22, A12), [group][tieCount()][3][lane];
  /// rows of the mean gradient and of the correction of the mean strain, and its value at rest,
  /// [group][kMeanDoubles][lane].
  bool assumed = false;
  AlignedVector<double> tie_u, tie_v, tie_share, tie_rest, tie_mean;
  AlignedVector<double> laws;  ///< [point][kLawDoubles][lane] where the law differs from point to point; else empty

  int nodeCount() const { return (p + 1) * (q + 1); }
  int pairCount() const { return nodeCount() * (nodeCount() + 1) / 2; }
  int pointDoubles() const { return 5 + (rational ? 6 : 0) + (rest_curvature ? 3 : 0); }
  int tieCount() const { return 2 * gv + 2 * gu + 4; }
  long firstPoint(int group) const { return scattered ? first_point[group] : static_cast<long>(group) * gu * gv; }
};

/// What the law needs at every point of a block, as resultants.
///   n_11 = d1 E11 + d3 E22, n_22 = d3 E11 + d2 E22, n_12 = d4 2E12 [N/m]; Zheng 2013, eq. 2.13 times the thickness
///   m_I  = bending law of kappa_I, I = weft, warp [N]; m_12 = twist * 2 kappa_12
/// with d in N/m and rigidities in N m. See core/material/bending.hpp for the law and its regularisation.
struct ShellLaw {
  double d1 = 0, d2 = 0, d3 = 0, d4 = 0;
  double bending_weft = 0, bending_warp = 0, twist = 0;
  double kappa0 = 0, kappa_regular = 0;  ///< kappa0 = 0: the linear law m = B kappa

  /// The same as a general law: what the tangent reads, and the force where `general` says that the numbers above are
  /// not enough.
  PointLaw point;
  bool general = false;
  bool zheng = false, tension = false, jams = false;  ///< whether any point follows eq. 2.14, is a tension field, jams
  /// What is left out, as in ShellTerms: of the general law in the kernel, of the numbers above by the caller.
  bool membrane = true, bending = true, steepest = false;
};

/// core/material/tension_field.hpp for each lane whose `on` is not 0: overwrites n, the energy per area and, where not
/// null, the slope. Arrays run [component][lane]. Compiled once, for all instruction sets.
void tensionFieldLanes(int lanes, const double* A, const double* strain, const double* on, double* n, double* energy,
                       double* slope);

/// Adds nothing: writes f_int per cell, [group][node][3][lane], and the energy of each lane of a group where `energy`
/// is not null.
using ShellForceKernel = void (*)(const ShellBlock&, const ShellLaw&, const double* q, double* cell_force,
                                  double* energy);

/// Writes d2E/dq2 of the cells of groups [first, first + count): [group - first][pair][9][lane]. Pairs of nodes I <= J,
/// I slowest; nine values row by row, rows for the components of I.
using ShellTangentKernel = void (*)(const ShellBlock&, const ShellLaw&, const double* q, int first, int count,
                                    double* pairs);

struct KernelSet {
  const char* name;  ///< "sse2", "avx2", "avx512"
  int lanes;
  ShellForceKernel force;
  ShellTangentKernel tangent;
  /// `rounds` rounds of independent multiply-adds in registers; returns flops done (to measure the core's peak).
  double (*multiplyAddPeak)(long rounds);
};

/// The widest set that this machine runs.
const KernelSet& widestKernels();
/// All sets that this machine runs, widest first.
std::span<const KernelSet* const> availableKernels();

}  // namespace gambeson
