#pragma once
/// What the movements of a joint, an added torque and a natural moment are called on a page.

#include <string>

#include "cases/wear/case/case.hpp"

namespace gambeson {

/// "flexes" for a rising flexion, "extends" for a falling one; and the nouns of either side.
struct MovementWords {
  const char *rises, *falls, *above, *below, *to_above, *to_below;
};
MovementWords movementWords(const std::string& movement);

/// What the garment does to a joint that moves: an added torque of the sense in which the joint turns is work on top
/// for the muscles; of the other sense, the garment turns the joint the way it goes.
enum class Push { held, against, along };
/// Below 0.02 rad/s a joint counts as held.
Push pushOf(double added_torque, double rate_rad_per_s);
/// "against the motion", "with the motion", "joint held still".
const char* nameOf(Push push);

/// What the sign of an added torque means for a movement, and when it hinders.
std::string signOf(const std::string& movement);

/// What the natural moment of a task is: a sentence, empty where there is none.
std::string naturalMeaning(Task task);

}  // namespace gambeson
