#pragma once
/// Who and what the cloth of a case touches: the human with its motion, and the case's own obstacles.

#include <vector>

#include "cases/wear/scene/scenario.hpp"
#include "cases/wear/scene/stage.hpp"
#include "core/contact/obstacle.hpp"

namespace gambeson {

/// Puts the bodies of the case into the scenario and on its stage, with the air about them and notes on what a user
/// should know of them; returns the obstacles, those of the human first. Throws InputError with the case's keys.
std::vector<Obstacle> placeBodies(const Case& c, Scenario& s, CaseStage& stage);

}  // namespace gambeson
