#pragma once
/// A captured motion in terms of our skeleton, still with the subject's size, path and clock.

#include <optional>
#include <string>
#include <vector>

#include "human/body/body.hpp"
#include "human/recorded/bvh.hpp"
#include "human/recorded/markers.hpp"
#include "human/recorded/osim.hpp"
#include "human/recorded/storage.hpp"
#include "human/skeleton/joint_map.hpp"
#include "human/skeleton/limb_angles.hpp"

namespace gambeson {

/// World: x forward, y left, z up, of the file's own origin.
struct CapturedMotion {
  std::string file, map;
  std::vector<double> times;           ///< as in the file [s]
  std::vector<Vec3> hips;              ///< midway between the hip joints [m]
  std::vector<Mat3> pelvis;            ///< orientation of the root link
  std::vector<std::vector<double>> q;  ///< of each instant, of each joint; angles without jumps
  std::vector<bool> driven;            ///< joints that the file moves; the others hold the standing posture
  double leg_m = 0;                    ///< hip to ankle of the subject; 0: not known
  double model_leg_m = 0;              ///< likewise of the model before it was scaled to the subject
  std::vector<std::string> notes;
};

/// Axes of the file's world where they differ from what the map says.
struct WorldAxes {
  Vec3 forward, up;
};

/// Each takes the world axes from `world`, or from the map where that is empty. They throw InputError where a name that
/// the map asks for is missing in the file.
CapturedMotion recordAngles(const StorageTable& table, const JointMap& map, const Human& human,
                            const std::optional<WorldAxes>& world = {});
CapturedMotion recordBones(const BvhClip& clip, const JointMap& map, const Human& human,
                           const std::optional<WorldAxes>& world = {});
/// `model` is needed by maps of kind markers.
CapturedMotion recordMarkers(const MarkerTable& table, const JointMap& map, const OsimModel* model, const Human& human,
                             const std::optional<WorldAxes>& world = {});

/// The directions that the bones of a hierarchy have at one frame, and those of markers; for tests and pictures too.
BodyDirections boneDirections(const BvhClip& clip, const JointMap& map, const std::vector<double>& frame,
                              const Mat3& R_ours_world);

/// Right and left names of a segment: index 0 right.
inline std::string sided(const char* segment, int side) {
  return std::string(segment) + (side == 0 ? "_right" : "_left");
}

/// Joint values of directions, one instant after the other.
void addDirections(CapturedMotion& r, const Human& human, const LimbJoints& joints, const BodyDirections& body);

}  // namespace gambeson
