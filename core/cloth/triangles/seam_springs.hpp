#pragma once
/// Rotational springs along seams of triangles (SewnSeam), each edge of a seam by itself.
///
/// What turns at a seam of stiffness k per length and angle is the seam and the cloth on either side of it, in a row:
///   E = 1/2 k' l (theta - alpha_a - alpha_b - rest angle)^2,   1/k' = 1/k + c_a + c_b,
/// theta the angle between the two triangles (hingeAngle) and l the mean length of the edge. Of triangles that bend by
/// a tensor with edges that turn (BendingElements::midedge) alpha is what their own edge turns, an unknown; c =
/// h/(10 D) only keeps steps long, and a stiff seam bends as cloth does that is longer by a fifth of a cell.
/// Of others alpha = 0 and c = h/(2 D), half a height of cloth: with k without bound that is the hinge of
/// TriangleCloth, whose energy on flat cloth is the same. h is the height of the triangle over the edge and D the
/// rigidity of its fabric for a curvature across it, both at rest. With k = 0 the seam is free. Valid in so far as the
/// cloth beside the seam bends in proportion to curvature, where alpha = 0: what its law remembers, it does not
/// remember here.

#include <array>
#include <span>
#include <vector>

#include "core/cloth/block_law.hpp"
#include "core/cloth/draft/seams.hpp"
#include "core/cloth/free_map.hpp"
#include "core/cloth/slot_gather.hpp"
#include "core/cloth/triangles/bending_triangles.hpp"
#include "core/cloth/triangles/rest_elements.hpp"
#include "core/math/block_matrix.hpp"

namespace gambeson {

/// An edge of a seam.
struct SeamSpring {
  /// Points at the start and the end of the edge in the seam's sense, on the side a and on b.
  std::array<std::array<int, 2>, 2> edge{};
  std::array<int, 2> triangle{};  ///< at it on either side
  double stiffness_N = 0;         ///< of the seam alone: moment per length and angle
  double rest_angle_rad = 0;
};

/// What an edge of a seam turns by, of points and of inner unknowns.
struct SeamHinge {
  HingePoint points;
  std::array<int, 2> turn{-1, -1};  ///< the inner unknown of either side; -1: none
  std::array<double, 2> sense{};    ///< with which it is a part of theta
};

class SeamSprings {
 public:
  SeamSprings() = default;
  /// Their contributions to forces have slots from `first_slot` on, a multiple of `lanes`, and are listed in `gather`.
  /// Springs between fabrics without rigidity are none. Inner unknowns of `bending` get the inertia that lets them
  /// turn in steps as long as before.
  SeamSprings(std::span<const SeamSpring> springs, std::span<const MembraneTriangle> triangles,
              std::span<const BlockLaw> laws, BendingTriangles& bending, int lanes, long first_slot,
              SlotGather& gather);

  const std::vector<SeamHinge>& hinges() const { return hinges_; }
  long slots() const { return slots_; }
  /// Writes dE/dq to the slots of all, adds - dE/d(inner unknown) and energy.
  void force(const ClothState& state, const ClothForce& out, const ForceTerms& terms, double* slots) const;
  /// The block rows of K that an edge has: its free points, and behind all points the inner unknowns, three in a block.
  std::vector<int> blocksOf(const SeamHinge& hinge, const FreeMap& map) const;
  void addStiffness(const FreeMap& map, const ClothState& state, const ForceTerms& terms, BlockMatrix& K) const;

 private:
  std::vector<SeamHinge> hinges_;
  long first_slot_ = 0, slots_ = 0;
};

}  // namespace gambeson
