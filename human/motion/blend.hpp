#pragma once
/// From one posture to another.

#include "human/motion/motion.hpp"

namespace gambeson {

/// Joint values and the root's origin linear in `share` (0: from, 1: to), the root turned about one axis by that share
/// of the angle. Both have the same joints.
Posture blend(const Posture& from, const Posture& to, double share);

}  // namespace gambeson
