#pragma once
/// Where the joints of a body lie within its landmarks.

#include <map>
#include <string>

#include "human/scan/landmarks.hpp"

namespace gambeson {

/// Joints by the link that each carries (thigh_left: the hip, ..., torso: the lumbar joint, head: that of the neck),
/// and toes_left, toes_right: a point ahead of the ankle at the ball of the foot. In the body's axes [m].
std::map<std::string, Vec3> jointsOf(const TriangleMesh& body, const Landmarks& landmarks);

}  // namespace gambeson
