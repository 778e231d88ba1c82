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

/// Edges of triangles that bend by their curvature tensor (BendingTriangles), all of one kind: with a rotation of their
/// normal, which the first triangle adds to half of the fold and the second takes from it; without; or with one
/// triangle alone and a rotation.
struct EdgeBlock {
  enum class Kind { turning, still, border };
  Kind kind = Kind::still;
  int groups = 0, count = 0;   ///< the last group is filled up with copies
  AlignedVector<int> corners;  ///< [group][4][lane] as foldAngle has them; empty at borders
  AlignedVector<int> couple;   ///< [group][side][lane]: where its triangles write theirs
  long first_angle = 0;        ///< of its angles, [group][side][lane]; where the normal is still, one for both
  long first_moment = 0;       ///< among all moments; of borders none
  long first_turn = 0;         ///< among the inner unknowns

  int sides() const { return kind == Kind::border ? 1 : 2; }
  int angles() const { return kind == Kind::turning ? 2 : 1; }  ///< of an edge
};

/// Triangles that bend by their curvature tensor, under one law. A last group is filled up with copies without area.
struct BendingBlock {
  int groups = 0;
  BlockLaw law;
  AlignedVector<int> angle;    ///< [group][edge][lane]: of its edges that face corner 0, 1, 2
  AlignedVector<double> rest;  ///< [group][kBendingDoubles][lane]
  long history_first = 0;      ///< as BlockLaw has it
  long first_couple = 0;       ///< [group][edge][lane]
};
/// rest: curvature (k11, k22, 2 k12) at rest, area, and curvature per angle of each edge (BentTriangle).
constexpr int kBendingDoubles = 13;

/// Elements that know no law but their own numbers. A last group is filled up with copies without stiffness.
struct PointBlock {
  int groups = 0;
  AlignedVector<int> corners;  ///< [group][corner][lane] points
  AlignedVector<double> rest;  ///< [group][...][lane] as the kind has it
};
/// rest: length, stiffness (CrossedSpring). Two corners.
constexpr int kSpringElementDoubles = 2;
/// rest: weights of the corners 1, 2 and 3 (QuadraticHinge). Four corners.
constexpr int kStencilDoubles = 3;

struct BendingKernels {
  /// The angles of a block's edges from points `q` and its inner unknowns `turn` (null: zeros), and 1/|e| of each.
  void (*angles)(const EdgeBlock& block, const double* q, const double* turn, double* angle, double* per_length);
  /// dE/dangle of each triangle's edges [N m], from all angles; energies as those of hinges.
  void (*bend)(const BendingBlock& block, const BlockLaw& law, const double* angle, double* couple, double* energy);
  /// From all couples: the moment of each edge of a block over its length [N], in the place of 1/|e|, and minus what
  /// acts on its inner unknowns [N m] (null: not asked).
  void (*moments)(const EdgeBlock& block, const double* couple, double* moment, double* turn_force);
  /// dE/dq of the springs' points, [group][2][3][lane]; energies as those of hinges.
  void (*springs)(const PointBlock& block, const double* q, double* slots, double* energy);
  /// The same of quadratic hinges, [group][4][3][lane].
  void (*stencils)(const PointBlock& block, const double* q, double* slots, double* energy);
};

struct TriangleKernels {
  const char* name;  ///< "sse2", "avx2", "avx512"
  int lanes;
  HingeKernel hinges;
  TriangleKernel triangles;
  DampingKernel damping;
  const BendingKernels* bending;
};

/// All sets that this machine runs, widest first.
std::span<const TriangleKernels* const> triangleKernels();

}  // namespace gambeson
