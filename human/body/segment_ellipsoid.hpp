#pragma once
/// An ellipsoid per segment of a recorded body, from two joints and a marker (Man 2006, section 5.1).

#include <string>
#include <vector>

#include "core/math/vec.hpp"

namespace gambeson {

/// Where a segment's ellipsoid stands, from its joints J1, J2 and a marker M beside the line between them, all in the
/// world [m] (Man 2006, 5.1): centre x_c = (J1 + J2) / 2;
///   e1 = (J2 - J1) / |J2 - J1|,  e2 = (M - x_c less its part along e1) made unit,  e3 = e1 x e2,
/// the columns of the rotation. It depends continuously on the points, and moves with them rigidly. Throws InputError
/// with the key `name` where a point is not finite, where J1 and J2 are nearer to each other than 1 mm, or M to the
/// line through them than a thousandth of their distance: no direction is known then.
Pose segmentPose(const Vec3& J1, const Vec3& J2, const Vec3& M, const std::string& name);

/// A segment over time: its points at each instant [m].
struct SegmentCourse {
  std::string name;
  std::vector<Vec3> J1, J2, M;
};

/// The poses of a segment at all its instants. Throws InputError as segmentPose does, with the instant, where the
/// numbers of points differ, or where e2 or e3 turns by more than a quarter turn from one instant to the next: M has
/// changed sides.
std::vector<Pose> segmentPoses(const SegmentCourse& segment);

}  // namespace gambeson
