#pragma once
/// Where the joints of a body lie within its landmarks.

#include <map>
#include <string>

#include "human/scan/landmarks.hpp"

namespace gambeson {

/// Joints by the link that each carries (thigh_left: the hip, ..., torso: the lumbar joint, head: that of the neck),
/// and toes_left, toes_right: a point ahead of the ankle at the ball of the foot. In the body's axes [m].
std::map<std::string, Vec3> jointsOf(const TriangleMesh& body, const Landmarks& landmarks);

/// Throws InputError with `file` and the limb as key where a segment between joints has a length that no person's has:
/// a landmark was taken for another.
void checkLengths(const std::map<std::string, Vec3>& joints, const Landmarks& landmarks, const std::string& file);

}  // namespace gambeson
