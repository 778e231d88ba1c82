#pragma once
/// Which way a scanned body stands, and in which unit.

#include <optional>
#include <string>
#include <vector>

#include "core/contact/obstacle.hpp"

namespace gambeson {

/// What was found, and what is given: absent values are guessed.
struct Stance {
  std::optional<double> height_m;  ///< of the body
  std::optional<Vec3> up, facing;  ///< axes of the file
};

/// Turns, moves and scales a closed body: x forward, y left, z up, metres, the lowest point at z = 0, the middle of the
/// feet at x = y = 0. Up is the axis along which one end is one piece (the head) and the other two (the feet); forward
/// the axis of least extent of the other two, towards the toes. A body that stands askew about the vertical is turned
/// to the principal axis of its level spread. The unit is the one among m, dm, cm, mm, inch and foot in which the body
/// is 1.2 to 2.3 m tall. Throws InputError with `file` and the key that would help (up, facing, height).
TriangleMesh upright(TriangleMesh body, const Stance& given, const std::string& file, std::vector<std::string>& notes);

}  // namespace gambeson
