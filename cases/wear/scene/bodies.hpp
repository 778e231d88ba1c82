#pragma once
/// Who and what the cloth of a case touches: the human with its motion, and the case's own obstacles.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/contact/obstacles/kind.hpp"
#include "cases/wear/scene/scenario.hpp"
#include "cases/wear/scene/stage.hpp"
#include "core/contact/obstacle.hpp"

namespace gambeson {

/// All that is made of the case's words and files about bodies, and takes these no more.
struct MadeBodies {
  std::optional<Human> human;
  std::unique_ptr<Motion> motion;  ///< null without a human
  Vec3 mean_velocity_m_per_s;      ///< of the pelvis
  double air_ramp_s = 0;           ///< in which air that goes along comes up to speed
  std::optional<FootReport> feet;
  std::optional<Hurdle> hurdle;           ///< what the motion steps over
  std::vector<MadeObstacle> obstacles;    ///< of the case, in its order
  std::vector<std::string> notes, facts;  ///< as those of a Scenario
};
/// Throws InputError with the case's keys.
MadeBodies makeBodies(const Case& c);

/// Up to which width folds of the human's skin are bridged (human/skin/bridge_folds.hpp) [m]; 0: none.
double bridgedFolds_m(const HumanCase& human);

/// Puts the bodies into the scenario and on its stage, with the air about them; returns the obstacles, those of the
/// human first.
std::vector<Obstacle> placeBodies(const Case& c, MadeBodies made, Scenario& s, CaseStage& stage);

}  // namespace gambeson
