#pragma once
/// Our skeleton as an OpenSim model (.osim, document version 40000) and a motion as its coordinates (.mot).
///
/// Bodies are our links by openSimBody's names (but the head stays a body of its own), in our frames, with mass and
/// centre of mass as our model has them; it has no inertia about that, and the file says 0. Ground is OpenSim's (y up):
/// the root's joint hangs on a frame of the ground that is turned into ours. A joint of ours is a PinJoint, SliderJoint
/// or WeldJoint between offset frames whose z (pin) or x (slider) is its axis, so that with our value q
///   X_PC = X_PJ R(axis, q) = (X_PJ A) R(z, q) Aᵀ,  A z = axis,
/// and its coordinate has our joint's name, value, unit and sense. The root has six coordinates with the meaning of
/// gait2392's pelvis: ROOT_tilt, _list and _rotation turn about z (right), x, y of the ground one after the other, and
/// ROOT_tx, _ty, _tz move it. Joints that follow another are held by CoordinateCouplerConstraints.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "human/motion/motion.hpp"

namespace gambeson {

/// The text of the .osim. `name` is the model's.
std::string openSimModel(const Skeleton& skeleton, const std::string& name);

/// Names of the model's coordinates: the root's six, then those of the joints that move, in our order.
std::vector<std::string> openSimCoordinates(const Skeleton& skeleton);

/// Their values [rad, m] for a posture. The root's tilt and rotation are those nearest to `before` (the values at the
/// time before; empty: none), so that they run on where the body turns around.
std::vector<double> openSimValues(const Skeleton& skeleton, const Posture& posture, std::span<const double> before);

/// The text of a .mot with these values, a row for each time, named after its file.
std::string openSimMotion(const std::string& name, const Skeleton& skeleton, std::span<const double> time_s,
                          std::span<const Posture> postures);

}  // namespace gambeson
