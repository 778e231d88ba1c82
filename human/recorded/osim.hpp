#pragma once
/// What marker trajectories need of an OpenSim model: where markers sit on bodies, and where joints are.

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// A function of one coordinate: constant, linear, or through points (linear between them, constant beyond).
struct OsimFunction {
  std::vector<double> x, y;  ///< a single point: constant
  double slope = 0;          ///< of a linear function, through (0, y[0])
  double at(double value) const;
};

/// Frames of OpenSim: x forward, y up, z right.
struct OsimBody {
  std::string parent;
  Vec3 joint_in_parent;                     ///< at translations of 0
  std::array<OsimFunction, 3> translation;  ///< of the joint, by its own coordinate (the knee's moves along)
  std::map<std::string, Vec3> markers;      ///< [m]
  bool turned = false;                      ///< the joint's frames are turned against the bodies: not supported

  /// The body's origin in its parent at a value of its joint's coordinate [rad].
  Vec3 originAt(double coordinate_rad) const;
};

struct OsimModel {
  std::string file;
  std::map<std::string, OsimBody> bodies;
  const OsimBody& body(const std::string& name) const;  ///< throws InputError where there is none, or it is turned
};

/// Reads models of version 2 and 3 (joints inside bodies) and 4 (JointSet). Joints whose frames are turned against
/// their bodies are refused where they matter: such a model needs OpenSim itself. Throws InputError with file and line.
OsimModel readOsim(const std::filesystem::path& file);

}  // namespace gambeson
