#pragma once
/// Characters from files: a skinned surface becomes a Human with the links and joints of our manikins, so that every
/// motion drives it and every garment can be drafted on it.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "human/body/body.hpp"
#include "human/character/rigged_mesh.hpp"

namespace gambeson {

struct CharacterOptions {
  std::filesystem::path file;               ///< .gltf, .glb, .fbx, or MakeHuman's base mesh (.obj)
  std::filesystem::path skeleton, weights;  ///< of MakeHuman's mesh
  std::vector<MorphTarget> targets;         ///< likewise
  std::string map;                 ///< a joint map of the kind "bones"; empty: the one that goes with the bones' names
  std::string like = "male_p50";   ///< the manikin whose limits of joints and shares of mass it takes
  std::optional<double> height_m;  ///< it is scaled to; otherwise as large as the file says
  double bridge_folds_m = 0;  ///< folds narrower than this are bridged (human/skin/bridge_folds.hpp); 0: none
  std::optional<double> mass_kg;  ///< otherwise that of its volume at 1,000 kg/m³ (a body with air in the lungs floats)
};

/// What was found in the file, and done with it.
struct CharacterReport {
  std::string map;      ///< the joint map that goes with its bones
  char pose = 0;        ///< T or A
  double arms_deg = 0;  ///< of the upper arms from hanging down, in the pose of the file
  double height_m = 0, volume_m3 = 0;
  std::vector<std::string> notes;
};

/// Joints stand where the bones' heads are. In the pose of the file pelvis and trunk are upright by definition, soles
/// flat, knees bend in the plane of thigh and foot and elbows in that of the bent arm; so a human that stands has the
/// limbs straight where the file bends them. Each bone that has no joint of its own moves with the next one towards the
/// root that has (fingers with the hand, collar bones with the trunk). Throws InputError with file and key.
Human loadCharacter(const CharacterOptions& options, CharacterReport* report = nullptr);
/// The same of a body (closed, its weights summing to 1) whose bones are named as our links, with toes_left and
/// toes_right for a point ahead of each ankle.
Human characterOf(RiggedMesh body, const CharacterOptions& options, CharacterReport* report = nullptr);

}  // namespace gambeson
