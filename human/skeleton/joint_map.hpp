#pragma once
/// Joint maps: how the names and conventions of a recorded motion lead to our skeleton. JSON; those that ship stand in
/// human/data/map_*.json.

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

enum class MapKind {
  coordinates,  ///< joint angles of an OpenSim model (.mot, .sto)
  bones,        ///< a hierarchy of bones (.bvh)
  markers,      ///< markers on the bodies of an OpenSim model (.trc with .osim)
  points,       ///< markers at joint centres (.trc)
};

/// Markers whose mean is meant.
using Points = std::vector<std::string>;

struct JointMap {
  std::string name;
  MapKind kind = MapKind::coordinates;
  std::vector<std::string> has, lacks;  ///< names by which a file is known to go with this map
  Vec3 forward{1, 0, 0}, up{0, 1, 0};   ///< of a body that stands in the zero or rest pose, in the file's axes

  // coordinates: joint value = scale * coordinate + offset
  struct Drive {
    std::string from;
    double scale = 1, offset_rad = 0;
    bool optional = false;  ///< files may lack it
  };
  std::map<std::string, Drive> joints;
  std::vector<std::pair<std::string, Vec3>> turns;  ///< of the pelvis, in this order, each about the turned axes
  std::array<std::string, 3> position;
  Vec3 hips_m;       ///< midway between the hip joints, in the pelvis's frame of the unscaled model
  double leg_m = 0;  ///< hip to ankle of the unscaled model

  // bones
  double unit_m = 1;
  bool position_adds = false;
  std::string pelvis_joint, torso_joint, head_joint;
  std::array<Points, 2> hips;        ///< right, left: joints (one name each) or points
  std::array<Points, 2> torso_bone;  ///< from, to
  /// thigh_right, ...: from, to
  std::map<std::string, std::array<Points, 2>> bones;

  // markers, points
  std::map<std::string, std::string> bodies;                  ///< our segment -> body of the model
  double knee_scale = 1;                                      ///< our knee flexion times this is the model's coordinate
  Points pelvis_marker;                                       ///< beside the line of the hips
  std::string pelvis_side;                                    ///< where it lies: front, back
  std::map<std::string, std::pair<Points, std::string>> aux;  ///< M of a segment and where it lies: front, back, ...
};

/// Reads a map from JSON text; throws InputError with file and key.
JointMap parseJointMap(std::string_view text, const std::string& file);
/// The maps that ship, those that ask for more names first.
std::vector<JointMap> shippedMaps();
/// "gait2392", ..., or the path of a JSON file.
JointMap findJointMap(const std::string& name_or_path);
/// Those that ship, are of this kind and go with these names.
std::vector<JointMap> mapsFor(const std::vector<MapKind>& kinds, const std::vector<std::string>& names);

/// The rotation from a file's axes to ours (x forward, y left, z up).
Mat3 axesOf(const Vec3& forward, const Vec3& up);
/// "x", "-x", ... as a unit vector; (0, 0, 0) for other words.
Vec3 namedAxis(const std::string& word);

}  // namespace gambeson
