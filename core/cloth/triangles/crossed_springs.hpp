#pragma once
/// Springs between the corners that neighbouring triangles do not share (Wong 2014, section 3.1.2).
///
/// E = k/2 (l - l0)^2 (core/material/laws/spring.hpp), l0 the distance at rest. Two triangles of the heights ha and hb
/// on their common edge, folded by theta, have l0 - l = ha hb theta^2/(2 l0) + ...: cloth that is flat at rest has no
/// stiffness there, and its energy goes with the fourth power of theta. Where k is not given it is such that the spring
/// stores what a hinge of the fabric's rigidities does, folded as a curvature of 1/cm folds it (or by a right angle,
/// where that is less): of plates it is right there and nowhere else. It also stiffens the cloth in its plane.

#include <span>
#include <vector>

#include "core/cloth/cloth_state.hpp"
#include "core/cloth/free_map.hpp"
#include "core/cloth/slot_gather.hpp"
#include "core/cloth/triangles/rest_elements.hpp"
#include "core/cloth/triangles/triangle_kernel.hpp"
#include "core/math/block_matrix.hpp"

namespace gambeson {

/// One spring.
struct CrossedSpring {
  std::array<int, 2> corner{};
  double rest_m = 0, stiffness_N_per_m = 0;
};

/// The spring over a fold, `first` and `second` the triangles at it. `stiffness_N_per_m`: 0: from the rigidities of
/// bending [N m] (Voigt 11 22 33 12 13 23).
CrossedSpring crossedSpring(const FoldHinge& hinge, const MembraneTriangle& first, const MembraneTriangle& second,
                            std::span<const double, 6> rigidity_Nm, double stiffness_N_per_m);

class CrossedSprings {
 public:
  CrossedSprings() = default;
  /// Their contributions to forces have slots from `first_slot` on and are listed in `gather`.
  CrossedSprings(std::vector<CrossedSpring> springs, const TriangleKernels& kernels, long first_slot,
                 SlotGather& gather);

  const std::vector<CrossedSpring>& springs() const { return springs_; }
  long slots() const { return 6L * block_.groups * lanes_; }
  /// Writes dE/dq to the slots of all elements; adds energy.
  void force(const ClothState& state, const ClothForce& out, bool bends, double* slots, ClothWork& work) const;
  void addStiffness(const FreeMap& map, std::span<const Vec3> q, bool definite, BlockMatrix& K) const;

 private:
  std::vector<CrossedSpring> springs_;
  PointBlock block_;
  const BendingKernels* kernels_ = nullptr;
  int lanes_ = 1;
  long first_slot_ = 0;
};

}  // namespace gambeson
