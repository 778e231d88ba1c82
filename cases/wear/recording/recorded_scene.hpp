#pragma once
/// The scene of a run as its recording holds it: whatever was read from files, drafted, made or worked out before the
/// first step, so that results need none of it again.

#include <map>
#include <memory>
#include <string>

#include "cases/wear/scene/scenario.hpp"
#include "core/io/recording.hpp"

namespace gambeson {

/// By name (cases/wear/recording/scene_fields.hpp):
///   human.*                     skeleton, shapes, masses, skin
///   motion.*                    the postures that results ask for (cases/wear/recording/recorded_motion.hpp)
///   mean_velocity, air_ramp     of the air that goes along with the pelvis
///   dressed.*, shrunk, shrunk_skin   posture and body that the garments are put on
///   feet.*                      how the feet stand
///   obstacles.*                 shape, origin and snapshots of each
///   garments.*, meshes.*        drafts in place, without fabric; triangles of those that are meshes
///   notes                       what a user should know
std::map<std::string, Values> sceneOf(const Scenario& scenario);

/// The scenario of the run whose scene this is; `c`: its case. No file that the case names is looked at. `file`: of the
/// recording, for messages. Throws InputError where the scene is damaged.
std::unique_ptr<Scenario> scenarioOf(const Case& c, const std::map<std::string, Values>& scene,
                                     const std::string& file);

}  // namespace gambeson
