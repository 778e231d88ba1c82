#pragma once
/// The curves of natural walking, made periodic and symmetric: angles over the phase of a stride.

#include "human/motion/periodic_spline.hpp"

namespace gambeson {

/// Phase 0 is right foot strike. Angles in rad with the signs of human/manikin/manikin.hpp; `leg` and `arm` curves are
/// the right side's, the left's stand half a stride later. Pelvis angles: yaw about z (right side forward +), roll
/// about x (right side down +), pitch about y (bowing forward +).
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

/// Mean pelvis tilt of walking in the data [degrees, anterior negative], the zero of our pelvis in all movements.
double pelvisZero_deg();

/// Stair ascent over the phase of a stride (two steps), with the same signs. The right foot stands on its tread from 0
/// to foot_off.
struct StairCurves {
  PeriodicSpline hip_flexion, hip_adduction, hip_rotation, ankle_flexion;
  PeriodicSpline knee_flexion;         ///< of the data
  PeriodicSpline knee_flexion_landed;  ///< without the swing's end: a knee that does not move before foot strike
  PeriodicSpline pelvis_yaw, pelvis_roll, pelvis_pitch;
  double foot_off = 0;  ///< phase at which a foot leaves its tread
};

/// From human/data/stairs_ascent.json, closed and made symmetric as the walk; the pelvis's zero is that of walking,
/// since it is one of how markers are placed.
StairCurves stairAscent();

}  // namespace gambeson
