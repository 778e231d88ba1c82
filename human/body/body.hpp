#pragma once
/// The body surface: shapes fixed to the links of a skeleton.

#include <memory>
#include <string>
#include <vector>

#include "core/contact/obstacle.hpp"
#include "human/skeleton/skeleton.hpp"

namespace gambeson {

struct Skin;  // human/body/skin.hpp

/// One shape of the surface. `X_LS` is the shape's frame in its link.
struct BodyShape {
  int link = 0;
  std::string name;
  Shape shape;
  Pose X_LS;
};

/// A skeleton with its surface. Segments are the links that carry a shape.
struct Human {
  Skeleton skeleton;
  std::vector<BodyShape> shapes;
  double mass_kg = 0;
  double stature_m = 0;
  std::shared_ptr<const Skin> skin;  ///< null: the shapes are the surface
};

/// The obstacles of a body, one per shape in the same order; the segment is the link's name. With a skin it is the only
/// obstacle, "skin", without the triangles that are switched off, and deforms (Stage::vertices gives skinPositions,
/// with folds bridged); the shapes are what is measured then.
std::vector<Obstacle> obstaclesOf(const Human& human);
/// Where these stand: as the shapes, or the identity.
std::vector<Placement> obstaclePlacementsOf(const Human& human, std::span<const Pose> link_poses);
/// Where the shapes stand for given link poses.
std::vector<Placement> placementsOf(const Human& human, std::span<const Pose> link_poses);

}  // namespace gambeson
