#pragma once
/// The curves of natural walking, made periodic and symmetric: angles over the phase of a stride.

#include "human/periodic_spline.hpp"

namespace gambeson {

/// Phase 0 is right foot strike. Angles in rad with the signs of human/manikin.hpp; `leg` and `arm` curves are the
/// right side's, the left's stand half a stride later. Pelvis angles: yaw about z (right side forward +), roll about x
/// (right side down +), pitch about y (bowing forward +).
struct WalkCurves {
  PeriodicSpline hip_flexion, hip_adduction, hip_rotation, knee_flexion, ankle_flexion;
  PeriodicSpline shoulder_flexion, elbow_flexion;
  PeriodicSpline pelvis_yaw, pelvis_roll, pelvis_pitch;
  double double_support = 0;  ///< length of each of the two double supports, in phase
};

/// From human/data/walk_natural.json (Bovi et al. 2011):
/// - closed: the difference of the end from the start is taken off linearly over the whole cycle about its mean, then a
///   periodic cubic spline (C²) goes through the 50 values;
/// - pelvis rotation and obliquity made antisymmetric, x(p) = -x(p + 1/2), the tilt symmetric, x(p) = x(p + 1/2);
/// - the mean tilt is the pelvis's zero: the thigh keeps its angle to the vertical (hip = thigh - tilt), so the mean
///   (-9 degrees) is added to the hip.
WalkCurves naturalWalk();

}  // namespace gambeson
