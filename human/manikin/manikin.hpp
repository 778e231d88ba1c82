#pragma once
/// What our manikins' joints mean, and the constants that keep their limbs apart.
///
/// World and link frames in the zero posture: x forward, y left, z up. The zero posture is upright with arms hanging
/// and feet forward; the root "pelvis" has its origin midway between the hip joints. Joints are named <what>_<side>.
/// Signs, the same on both sides (so the axes of adduction, abduction and rotation are mirrored):
///   hip_flexion, shoulder_flexion, elbow_flexion +: the distal end swings forward;  knee_flexion +: it swings backward
///   ankle_flexion +: dorsiflexion (toes up);  hip_adduction +: towards the midline;  shoulder_abduction +: away from
///   it hip_rotation, shoulder_rotation +: internal (the front turns towards the midline) lumbar_flexion +: bows
///   forward;  lumbar_bending +: to the right;  lumbar_rotation +: right shoulder forward neck_flexion +: nods forward
/// Massless links <segment>_f1, <segment>_f2 stand between the joints of a hip, a shoulder and the lumbar joint.

#include <filesystem>
#include <string>
#include <vector>

#include "human/body/body.hpp"
#include "human/files/units.hpp"

namespace gambeson {

/// Held throughout standing and walking: the thighs of the data overlap at abduction 0, and the forearms would brush
/// the shorts.
inline constexpr double held_hip_abduction_rad = 4.5 * rad_per_deg;
inline constexpr double held_shoulder_abduction_rad = 20.0 * rad_per_deg;

/// Their names, smallest male first.
const std::vector<std::string>& manikinNames();

/// Our own manikin by name (male_p5 ... female_p95), generated from the facts in human/data.
Human makeManikin(const std::string& name);
/// The same manikin as a URDF and a body file that loadHuman reads back.
void writeManikin(const std::string& name, const std::filesystem::path& urdf, const std::filesystem::path& body);

}  // namespace gambeson
