#pragma once
/// Girths of a body where a tailor takes them, in any posture.

#include <array>
#include <span>
#include <string>
#include <vector>

#include "human/body/body.hpp"

namespace gambeson {

/// Where the planes are: of the trunk (the lumbar joint to the neck's), the thigh and the upper arm.
inline constexpr double kWaistShare = 0.1, kChestShare = 0.56, kThighShare = 0.35, kUpperArmShare = 0.5;

/// Across a part of the body: hip (through the hip joints), waist (a tenth of the way from the lumbar joint to the
/// neck's), chest (0.56 of it), thigh_left, thigh_right (0.35 of the thigh below the hip joint), upper_arm_left,
/// upper_arm_right (halfway). The plane moves with its link; e1 and e2 span it.
struct GirthPlane {
  std::string zone;
  Vec3 origin, e1, e2;
  std::vector<int> links;  ///< whose surface is measured
};

/// Those whose links the skeleton has, at these link poses.
std::vector<GirthPlane> girthPlanes(const Human& human, std::span<const Pose> link_poses);

/// Where a plane cuts triangles: ends of pieces, in the plane's axes.
std::vector<std::array<Vec2, 2>> cutPieces(const GirthPlane& plane, std::span<const Vec3> x,
                                           std::span<const std::array<int, 3>> triangles);

/// A piece of cloth in a plane, and how long the same cloth is at rest [m]. Neighbours have an edge of the mesh, by its
/// vertices, in common.
struct ClothPiece {
  std::array<Vec2, 2> ends;
  std::array<std::array<int, 2>, 2> edges{};
  double rest_m = 0;
};

/// Where a plane cuts cloth that stands at `x`, and at `rest` where nothing stretches it.
std::vector<ClothPiece> cutCloth(const GirthPlane& plane, std::span<const Vec3> x, std::span<const Vec3> rest,
                                 std::span<const std::array<int, 3>> triangles);

/// Points of the body's own surface in the plane, in its axes: of its shapes, or of its skin with vertices `skin_x`
/// (empty without a skin), of which a triangle belongs to a link with most of its vertices.
std::vector<Vec2> bodySection(const Human& human, const GirthPlane& plane, std::span<const Pose> link_poses,
                              std::span<const Vec3> skin_x);

}  // namespace gambeson
