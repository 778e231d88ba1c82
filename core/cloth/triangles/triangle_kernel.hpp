#pragma once
/// The element kernels of triangles and hinges: data as the kernels want it, and the choice of instruction set. One
/// lane of a vector is one element; a group is as many elements as the vector has lanes.

#include <span>
#include <vector>

#include "core/cloth/block_law.hpp"
#include "core/cloth/triangles/triangle_membrane.hpp"
#include "core/math/aligned.hpp"

namespace gambeson {

/// Elements of one kind under one law. A last group is filled up with copies whose area is zero.
struct ElementBlock {
  int groups = 0;
  BlockLaw law;
  AlignedVector<int> corners;  ///< [group][corner][lane] points
  AlignedVector<double> rest;  ///< [group][...][lane] as the kind has it
  long history_first = 0;      ///< of hinges, as BlockLaw has it
  bool seam = false;           ///< of hinges: between two patches
  /// Of triangles, [group][edge][lane]: the hinge at the edge that faces corner 0, 1, 2, by its index among all
  /// moments.
  AlignedVector<int> hinge;
  TriangleMembrane membrane;      ///< of triangles
  AlignedVector<double> springs;  ///< [group][kSpringDoubles][lane], of a membrane of springs; copies have none
  long first = 0;  ///< of triangles: slot; of hinges: index among all moments
};
/// rest: g[0].x, g[0].y, g[1].x, g[1].y, area (MembraneTriangle). Three corners.
constexpr int kMembraneDoubles = 5;
/// springs: their lengths at rest, stiffnesses, and the damping of each (TriangleSprings).
constexpr int kSpringDoubles = 7;
/// rest: theta0, per_angle, area, d (FoldHinge). Four corners.
constexpr int kHingeDoubles = 6;

/// Both write the energy of each lane of a group where `energy` is not null, and add nothing.
///
/// Of hinges: the moment dE/dtheta of each over its length [N], [group][lane]. A hinge's force on the corners of either
/// triangle is along that triangle's normal: it takes no more to hand it on.
using HingeKernel = void (*)(const ElementBlock& block, const BlockLaw& law, const double* q, double* moment,
                             double* energy);
/// Of triangles: dE/dq of their corners, [group][corner][3][lane], of their membrane and of the hinges at their edges;
/// `moment` of all hinges.
using TriangleKernel = void (*)(const ElementBlock& block, const BlockLaw& law, const double* q, const double* moment,
                                double* slots, double* energy);
/// Of triangles that damp: minus the force on their corners at the velocities v, as above; their power where that is
/// not null [W].
using DampingKernel = void (*)(const ElementBlock& block, const double* q, const double* v, double* slots,
                               double* power);

struct TriangleKernels {
  const char* name;  ///< "sse2", "avx2", "avx512"
  int lanes;
  HingeKernel hinges;
  TriangleKernel triangles;
  DampingKernel damping;
};

/// All sets that this machine runs, widest first.
std::span<const TriangleKernels* const> triangleKernels();

}  // namespace gambeson
