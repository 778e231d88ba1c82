#pragma once
/// A foot that rolls on the ground without slip, and steps.

#include <vector>

#include "human/motion/leg.hpp"

namespace gambeson {

/// What a foot is to do at an instant.
struct FootGoal {
  double pitch = 0;  ///< of the sole, toes up + [rad]
  Vec3 way;          ///< x, y: how far its lowest point has been carried; z: height of that above the ground [m]
};

/// The ankle of a leg at instants whose steps are small, from `ankle_W` at the first: between two instants the material
/// point of the foot midway between both lowest ones is carried from one way to the other (second order). So a foot
/// whose way does not change rolls without slip, and one whose height is 0 touches the ground z = 0. Orientation:
/// footRotation. All vectors have one value per instant.
std::vector<Vec3> rolledAnkles(const Leg& leg, const std::vector<Pose>& pelvis, const std::vector<FootGoal>& goals,
                               Vec3 ankle_W);

}  // namespace gambeson
