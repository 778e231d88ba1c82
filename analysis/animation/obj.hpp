#pragma once
/// One time of an animated scene as a Wavefront OBJ: a group for each mesh, in our axes (z up) and metres.

#include <string>

#include "analysis/animation/scene.hpp"

namespace gambeson {

/// Positions in the shortest form that reads back to the same single precision.
std::string encodeObj(const AnimatedScene& scene, std::size_t time);

/// PATH/walk.obj of time 6 is PATH/walk_0007.obj.
std::string numbered(const std::string& file, std::size_t time);

}  // namespace gambeson
