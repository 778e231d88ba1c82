#pragma once
/// The element kernel of the Kirchhoff-Love shell: data as the kernels want it, and the choice of instruction set.
/// One lane of a vector is one cell; a group is as many cells as the vector has lanes.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/cloth/block_law.hpp"
#include "core/math/aligned.hpp"

namespace gambeson {

constexpr int kTieWeightDoubles = 33;  ///< of the ties at a Gauss point, and of the correction of the mean
constexpr int kMeanDoubles = 75;       ///< of a cell's correction of the mean
constexpr int kMaxTies = 8;            ///< Gauss points per direction of a cell with assumed strains

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
  /// [group][2][2][degree + 1][lane] values and first derivatives; weights of the ties at the Gauss points,
  /// [point][kTieWeightDoubles][lane]; covariant rest metric at the ties (A11, A22, A12), [group][tieCount()][3][lane];
  /// rows of the mean gradient and of the correction of the mean strain, and its value at rest,
  /// [group][kMeanDoubles][lane].
  bool assumed = false;
  AlignedVector<double> tie_u, tie_v, tie_weight, tie_rest, tie_mean;
  AlignedVector<double> laws;   ///< [point][kLawDoubles][lane] where the law differs from point to point; else empty
  std::vector<int> law_varies;  ///< which of these are not everywhere what BlockLaw::point has
  long history_first = 0;       ///< as BlockLaw has it

  int nodeCount() const { return (p + 1) * (q + 1); }
  int pairCount() const { return nodeCount() * (nodeCount() + 1) / 2; }
  int pointDoubles() const { return 5 + (rational ? 6 : 0) + (rest_curvature ? 3 : 0); }
  int tieCount() const { return 2 * gv + 2 * gu + 4; }
  LawsByPoint lawsByPoint() const {
    return {laws.empty() ? nullptr : laws.data(), {law_varies.data(), law_varies.size()}};
  }
  long firstPoint(int group) const { return scattered ? first_point[group] : static_cast<long>(group) * gu * gv; }
};

/// Adds nothing: writes f_int per cell, [group][node][3][lane], and the energy of each lane of a group where `energy`
/// is not null.
using ShellForceKernel = void (*)(const ShellBlock&, const BlockLaw&, const double* q, double* cell_force,
                                  double* energy);

/// Writes d2E/dq2 of the cells of groups [first, first + count): [group - first][pair][9][lane]. Pairs of nodes I <= J,
/// I slowest; nine values row by row, rows for the components of I.
using ShellTangentKernel = void (*)(const ShellBlock&, const BlockLaw&, const double* q, int first, int count,
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
