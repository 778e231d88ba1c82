#pragma once
/// Feet and the level ground z = 0.

#include <array>
#include <vector>

#include "human/motion.hpp"

namespace gambeson {

/// The shapes on each foot: all links from the ankle on; right, left. Throws InputError where a foot has none.
std::array<std::vector<const BodyShape*>, 2> footShapes(const Human& human);

/// A foot's lowest point: its height, and the shape and the material point on it (in the shape's frame).
struct LowestOfFoot {
  double z = 0;
  const BodyShape* shape = nullptr;
  Vec3 point_S;
};
LowestOfFoot lowestOfFoot(const std::vector<const BodyShape*>& foot, const std::vector<Pose>& X_WL);

}  // namespace gambeson
