#pragma once
/// Trimming loops in lengths, on flat rectangular patches.

#include <span>

#include "core/nurbs/trim.hpp"

namespace gambeson {

/// What a loop leaves: its inside (an outline) or its outside (a hole).
enum class Keep { inside, outside };

/// Lengths along u and v from the corner (u0, v0) of a patch that is a flat rectangle with even parameters
/// (control points at the Greville points, equal weights). Throws InputError for other patches: a circle in
/// parameters is none on them.
struct FlatRectangle {
  Vec2 length_m;
  Vec2 origin, range;  ///< parameters of the corner, and their ranges
  Vec2 parameters(Vec2 at_m) const {
    return {origin.x + at_m.x / length_m.x * range.x, origin.y + at_m.y / length_m.y * range.y};
  }
};
FlatRectangle flatRectangle(const NurbsPatch& patch);

/// Loops in the right sense for `keep`, whichever way the points run.
TrimLoop circleLoop(const NurbsPatch& patch, Vec2 center_m, double radius_m, Keep keep);
TrimLoop polygonLoop(const NurbsPatch& patch, std::span<const Vec2> corners_m, Keep keep);
/// A closed, C2 cubic through the points, by chord length in metres.
TrimLoop splineLoop(const NurbsPatch& patch, std::span<const Vec2> points_m, Keep keep);

}  // namespace gambeson
