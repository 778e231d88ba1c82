#pragma once
/// The element kernel of the Kirchhoff-Love shell: data as the kernels want it, and the choice of instruction set.
/// One lane of a vector is one cell; a group is as many cells as the vector has lanes.

#include <span>
#include <string>
#include <vector>

#include "core/math/aligned.hpp"

namespace gambeson {

/// Cells of one degree pair and one quadrature rule, packed for vectors of `lanes` doubles. All arrays run
/// [group][...][lane]; a last group is filled up with copies of a cell whose area is zero.
struct ShellBlock {
  int lanes = 1, groups = 0;
  int p = 2, q = 2;    ///< degrees along u and v
  int gu = 3, gv = 3;  ///< quadrature points along u and v
  bool rational = false;
  AlignedVector<int> nodes;       ///< [group][(p+1)(q+1)][lane] control point, u fastest
  AlignedVector<double> weights;  ///< [group][(p+1)(q+1)][lane], rational blocks only
  AlignedVector<double> basis_u;  ///< [group][gu][3][p+1][lane]: B-spline values, first and second derivatives
  AlignedVector<double> basis_v;  ///< [group][gv][3][q+1][lane]
  AlignedVector<double>
      points;  ///< [group][gv][gu][pointDoubles()][lane]: G11 G12 G21 G22 dA (w w1 w2 w11 w22 w12) (k11 k22 k12)
  bool rest_curvature = false;  ///< whether the rest curvature (physical components) is subtracted

  int nodeCount() const { return (p + 1) * (q + 1); }
  int pointDoubles() const { return 5 + (rational ? 6 : 0) + (rest_curvature ? 3 : 0); }
};

/// What the law needs at every point of a block, as resultants.
///   n_11 = d1 E11 + d3 E22, n_22 = d3 E11 + d2 E22, n_12 = d4 2E12 [N/m]; Zheng 2013, eq. 2.13 times the thickness
///   m_I  = bending law of kappa_I, I = weft, warp [N]; m_12 = twist * 2 kappa_12
/// with d in N/m and rigidities in N m. See core/material/bending.hpp for the law and its regularisation.
struct ShellLaw {
  double d1 = 0, d2 = 0, d3 = 0, d4 = 0;
  double bending_weft = 0, bending_warp = 0, twist = 0;
  double kappa0 = 0, kappa_regular = 0;  ///< kappa0 = 0: the linear law m = B kappa
};

/// Adds nothing: writes f_int per cell, [group][node][3][lane], and the energy of each lane of a group where `energy`
/// is not null.
using ShellForceKernel = void (*)(const ShellBlock&, const ShellLaw&, const double* q, double* cell_force,
                                  double* energy);

struct KernelSet {
  const char* name;  ///< "sse2", "avx2", "avx512"
  int lanes;
  ShellForceKernel force;
  /// `rounds` rounds of independent multiply-adds in registers; returns flops done (to measure the core's peak).
  double (*multiplyAddPeak)(long rounds);
};

/// The widest set that this machine runs.
const KernelSet& widestKernels();
/// All sets that this machine runs, widest first.
std::span<const KernelSet* const> availableKernels();

}  // namespace gambeson
