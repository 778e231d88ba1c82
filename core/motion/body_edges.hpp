#pragma once
/// Persistent contact of cloth with the sharp edges and corners of bodies between its samples. Internal to
/// core/motion.

#include <span>
#include <vector>

#include "core/motion/collisions.hpp"

namespace gambeson {

/// Marks what cloth may rest on between its samples: edges of bodies at which two faces bend by more than 30 degrees or
/// that have one face, and corners no blunter than that. `x`: positions of the mesh's vertices. What belongs to a body
/// that deforms is marked all, and asked in each step where cloth comes near it.
void markSharp(CollisionModel& model, std::span<const Vec3> x);

/// Rows without a target for cloth that is within contactReach of a sharp edge or corner of a body at work.x0 -> x1,
/// and nearest to it inside of a triangle or an edge of the cloth. Where a body is smoother than the cloth's triangles,
/// samples on its surface carry the cloth (Zheng 2013, section 3.2.1); an edge that they straddle holds it only by
/// impacts, from step to step: the cloth then trembles by the part of the layer that impacts restore. Left out
/// are samples that are tangled or inside of a body. Their features are negative, which keeps them apart from contacts
/// of samples. Sorted by sample, obstacle, feature.
void bodyEdgeRows(const CollisionModel& model, double dt_s, std::span<const char> inside, const CollisionWork& work,
                  std::vector<ContactRow>& rows);

}  // namespace gambeson
