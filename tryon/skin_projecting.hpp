#pragma once
/// Virtual projecting (tryon/projecting.hpp) on a skin: the skin shrinks towards its bones until the garment is free of
/// it.
///
/// Every link l that carries a shape has an axis, a segment along its largest shape's longest direction. A vertex x of
/// weights w_l goes to
///   x + sum_l w_l (1 - k_l) (a_l(x) - x),   a_l(x) the nearest point of axis l,
/// a smooth field where the weights are smooth, with one factor k_l of each link. Links that touch samples
/// shrink in steps of 2 % until no sample is touched; then each is tried one step larger.

#include <span>
#include <vector>

#include "human/body/body.hpp"
#include "human/body/skin.hpp"

namespace gambeson {

struct ShrunkSkin {
  std::vector<double> factor;  ///< of each link; 1 where it stays as it is
  std::vector<Vec3> x;         ///< of the vertices
};

/// At the posture of `link_poses`; every sample is at least `clearance_m` (> 0) outside then. Throws RunError naming
/// the links that cannot be freed (below tryon/projecting.hpp's least scale).
ShrunkSkin shrinkSkinToFree(const Human& human, std::span<const Pose> link_poses, std::span<const Vec3> samples,
                            double clearance_m);

}  // namespace gambeson
