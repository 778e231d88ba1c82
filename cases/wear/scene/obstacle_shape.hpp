#pragma once
/// The shapes of the obstacles that a case places beside or in place of a human.

#include "cases/wear/case/case.hpp"
#include "core/contact/obstacle.hpp"

namespace gambeson {

/// In its own frame [m]; `at` becomes where that stands at time 0. Spheres without rings stay exact; of a sequence of
/// meshes only the frame, none of its triangles. Throws InputError where a file does not read.
Shape shapeOf(const ObstacleCase& obstacle, Placement& at);

}  // namespace gambeson
