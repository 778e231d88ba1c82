#pragma once
/// Virtual stitching (Zheng 2013, section 6.3): the panels of a garment stand around the body without touching it,
/// springs along the pairs of edges that belong together close them (core/motion/stitch.hpp), then they are sewn.
///
/// The garment is drafted sewn, around the body. Panels are what seams join; unsewn, each keeps its rest shape.

#include <span>
#include <vector>

#include "core/cloth/cloth.hpp"
#include "core/cloth/draft/garment.hpp"
#include "core/motion/stitch.hpp"

namespace gambeson {

/// The panels without their seams.
Garment unsewn(const Garment& garment);

/// How far each panel moves off to stand clear of the body: `distance_m` along its mean normal at rest (area-weighted,
/// seen from outside) where at least `facing` of it points that way; panels that wrap around the body stay where they
/// are: what is drafted around a body is free of it.
std::vector<Vec3> panelOffsets(const Garment& garment, double distance_m, double facing = 0.7);

struct StitchLaw {
  double stiffness_N_per_m2 = 1000;  ///< k of eq. 6.2, per length of seam
  double damping_kg_per_m_s = 1;     ///< eta, per length of seam
};
/// One spring from every sample along edge a of each seam (also weak ones) to the sample of edge b that is nearest to
/// it at rest, with the length of seam that it answers for: half of that to either neighbour. `cloth` and `surface` are
/// those of the unsewn garment.
std::vector<Stitch> stitchesOf(const Garment& garment, const Cloth& cloth, const Surface& surface,
                               const StitchLaw& law);

/// The free points of the sewn garment nearest to where the unsewn control points are: p that minimises |T p - q|^2.
std::vector<Vec3> sew(const FreeMap& sewn, std::span<const Vec3> q);

}  // namespace gambeson
