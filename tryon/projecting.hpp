#pragma once
/// Virtual projecting (Zheng 2013, section 6.3): the body shrinks until the garment is free of it and grows back into
/// it.
///
/// Every shape shrinks by its own factor about its own centre, a point of its bone: thighs stay inside the garment's
/// legs. One factor for the whole body about one centre would be simpler, but it carries the thighs' axes off the legs'
/// and shrinks parts that touch nothing. A shape that contains the segment from its centre to each of its points (every
/// ellipsoid) gets free of a point only by shrinking, and stays free of it while shrinking on: the factors found are
/// the largest, to 1e-4. The cloth must not pass through a bone: what lies on which side of the centre stays there.

#include <span>
#include <vector>

#include "core/contact/obstacle.hpp"
#include "core/contact/proximity.hpp"

namespace gambeson {

/// No shape shrinks below this share of its size.
inline constexpr double least_projecting_scale = 0.1;

/// Where the shapes stand when each has shrunk just so far that every sample is `clearance_m` (> 0) outside it. Shapes
/// that are free stay as they are. `query` is over the same obstacles. Throws RunError naming the segments that cannot
/// be freed.
std::vector<Placement> shrinkToFree(const ProximityQuery& query, std::span<const Obstacle> obstacles,
                                    std::span<const Placement> standing, std::span<const Vec3> samples,
                                    double clearance_m);

/// How much has grown back at a phase of growing: 3 s² - 2 s³, 0 before and 1 after.
double grownPart(double phase);

/// Growing back: `shrunk` at phase 0, `standing` at 1 and beyond, with 3 s² - 2 s³ in between, so that every point of
/// the surface has a continuous velocity that starts and ends at zero.
std::vector<Placement> placementsDuringGrowth(std::span<const Placement> standing, std::span<const Placement> shrunk,
                                              double phase);

}  // namespace gambeson
