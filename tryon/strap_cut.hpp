#pragma once
/// What straps carry: the resultant of the stress over a cut across each end.

#include <span>
#include <string>
#include <vector>

#include "core/cloth/cloth.hpp"

namespace gambeson {

/// Across a patch that is sewn to others at two opposite sides, two rows of points from one of them: these alone feel
/// the seam's spring.
struct StrapCut {
  int patch = 0;
  bool at_end = false;      ///< of v1 (u1), else of v0 (u0)
  double width_m = 0;       ///< of the sewn side at rest
  std::vector<int> beyond;  ///< points of the strap beyond the cut
};

/// Both ends of each strap: a patch whose name's last word starts with "strap", that is sewn at two opposite sides and
/// at no other (a sleeve sewn to a third side pulls at what is between the cuts), and has points between the cuts.
std::vector<StrapCut> strapCuts(const Cloth& cloth, std::span<const std::string> patch_names);

/// Of each point how much of it lies beyond the cuts, away from the straps' middles: 1, but 0 between the cuts
/// of a strap; other garments than those with straps count 1 or (`own`) 0.
std::vector<double> weightsBelow(const Cloth& cloth, std::span<const StrapCut> cuts, bool own);

/// The force of the strap's middle on what lies beyond each cut [N]: the sum of the strap's own membrane and bending
/// forces on the control points beyond it. With w the weights of these points this is the integral of the stress
/// resultants, shear of bending included, against the gradient of w; the discrete equations of motion of what lies
/// beyond the cuts hold with it exactly: pulls + weight + contact = change of momentum, in the frame's own numbers
/// (contact of cloth with cloth cancels where all garments count).
std::vector<Vec3> strapPulls(const Cloth& cloth, const ClothState& state, std::span<const StrapCut> cuts,
                             ClothWork& work);

}  // namespace gambeson
