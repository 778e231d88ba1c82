#pragma once
/// Standing upright.

#include "human/motion/motion.hpp"

namespace gambeson {

/// The skeleton's zero posture with the root where the manikin stands on the ground (z = 0).
Posture standing(const Human& human);

}  // namespace gambeson
