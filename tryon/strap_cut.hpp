#pragma once
/// What straps carry: the resultant of the stress over a cut across each end.

#include <span>
#include <string>
#include <vector>

#include "core/cloth/shell/shell.hpp"

namespace gambeson {

/// Across a patch that is sewn to others at two opposite sides, two rows of control points from one of them: rows 0 and
/// 1 alone feel the seam's spring.
struct StrapCut {
  int patch = 0;
  bool along_v = true;  ///< the strap runs from v0 to v1, else from u0 to u1
  bool at_end = false;  ///< at v1 (u1), else at v0 (u0)
  double width_m = 0;   ///< of the sewn side at rest
};

/// Both ends of each strap: a patch whose name's last word starts with "strap", that is sewn at two opposite sides (and
/// not at all four), and has at least five rows of control points between them.
std::vector<StrapCut> strapCuts(const Garment& garment, std::span<const std::string> patch_names);

/// Of each control point how much of it lies beyond the cuts, away from the straps' middles: 1, but 0 between the cuts
/// of a strap; other layers than those with straps count 1 or (`own`) 0.
std::vector<double> weightsBelow(const Garment& garment, std::span<const StrapCut> cuts, bool own);

/// The force of the strap's middle on what lies beyond each cut [N]: the sum of the strap's own membrane and bending
/// forces on the control points beyond it. With w the weights of these points this is the integral of the stress
/// resultants, shear of bending included, against the gradient of w; the discrete equations of motion of what lies
/// beyond the cuts hold with it exactly: pulls + weight + contact = change of momentum, in the frame's own numbers
/// (contact of cloth with cloth cancels where all layers count).
std::vector<Vec3> strapPulls(const Shell& shell, std::span<const Vec3> q, std::span<const StrapCut> cuts,
                             ShellWork& work);

}  // namespace gambeson
