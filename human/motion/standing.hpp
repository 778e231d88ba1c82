#pragma once
/// Standing upright.

#include "human/motion/motion.hpp"

namespace gambeson {

/// The skeleton's zero posture with the root where the manikin stands on the ground (z = 0), legs and arms held a
/// little aside (human/manikin/manikin.hpp), arms further where the shoulder's lower limit asks for it.
Posture standing(const Human& human);

/// The posture that the skin is given in: of a scan or a character that of its file. Standing without a skin.
Posture postureOfSkin(const Human& human);

}  // namespace gambeson
