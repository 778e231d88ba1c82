#pragma once
/// Feet and the level ground z = 0.

#include <array>
#include <vector>

#include "human/motion/motion.hpp"

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

/// How the feet of a motion meet the ground z = 0.
struct FeetReport {
  double deepest_m = 0;       ///< largest penetration of either foot
  double highest_m = 0;       ///< largest height of the lower foot: hovering, or flight
  double slip_m_per_s = 0;    ///< RMS speed of the lowest point of a foot that carries (below 10 mm), along the ground
  double slip_of_travel = 0;  ///< path that carrying feet slip over the path of the pelvis; 0 where it does not travel
};
/// Sampled every `step_s` from `from_s` on.
FeetReport feetOnGround(const Human& human, const Motion& motion, double from_s = 0, double step_s = 0.005);

}  // namespace gambeson
