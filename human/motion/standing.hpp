#pragma once
/// Standing upright.

#include "human/motion/motion.hpp"

namespace gambeson {

/// The skeleton's zero posture with the root where the manikin stands on the ground (z = 0).
Posture standing(const Human& human);

/// The posture that the skin is given in: of a scan or a character that of its file. Standing without a skin.
Posture postureOfSkin(const Human& human);

}  // namespace gambeson
