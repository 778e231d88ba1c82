#pragma once
/// Where a body meets level ground.

#include <optional>
#include <string>

#include "human/body/body.hpp"

namespace gambeson {

/// The lowest point of a shape, in its own frame, when it stands with rotation R_WS. Ellipsoid: A² d / |A d| with d =
/// -R_WSᵀ e_z.
Vec3 lowestPoint(const Shape& shape, const Mat3& R_WS);

/// Height of the lowest point of all shapes.
double lowestHeight(const Human& human, std::span<const Pose> link_poses);

/// Stairs that rise along x: tread k >= 1 lies at the height k rise from x = first_edge + (k - 1) tread on; the ground
/// z = 0 before them is tread 0. All [m].
struct Stairs {
  double rise_m = 0, tread_m = 0, first_edge_m = 0;
  double heightAt(double x_m) const;
};

/// A box across the way, without ends to the sides: front <= x <= front + depth, below `height`. All [m].
struct Hurdle {
  double front_m = 0, depth_m = 0, height_m = 0;
};

/// The foot of a side: the ellipsoid on the link that the joint ankle_flexion_<side> moves. Throws InputError where
/// there is none; `what` needs it.
const BodyShape& footOf(const Human& human, const std::string& side, const std::string& what);

/// Signed distance of a shape from stairs, or from the ground z = 0 without: the smallest over the steps of the gap
/// between it and that step, where the gap is the largest over supporting planes of the step (exact for convex shapes
/// but for the sampling of the planes' direction, 2 degrees: at an edge it may be short by 2e-4 of the way to it).
/// Meshes count as their convex hulls. `nearest`: the step that is nearest.
double gapTo(const Shape& shape, const Pose& X_WS, const std::optional<Stairs>& stairs, int* nearest = nullptr);
/// Signed distance of a shape from a hurdle, with the same supporting planes, but in steps of half a degree.
double gapToHurdle(const Shape& shape, const Pose& X_WS, const Hurdle& hurdle);

}  // namespace gambeson
