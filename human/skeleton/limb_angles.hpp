#pragma once
/// Joint angles of our skeleton from the directions of a body's bones in the world, in closed form.

#include <array>
#include <optional>

#include "human/skeleton/skeleton.hpp"

namespace gambeson {

/// Two bones that a hinge joins (thigh and shank, upper arm and forearm). Unit vectors in the world.
struct LimbDirections {
  Vec3 upper, lower;  ///< from the proximal to the distal joint
  /// Where the hinge's axis points (knee: left; elbow: right), for a limb that is nearly straight.
  Vec3 hinge;
};

/// One instant of a recorded body. World and frames: x forward, y left, z up; index 0 is the right side, 1 the left.
struct BodyDirections {
  Vec3 hips;    ///< midway between the hip joints
  Mat3 pelvis;  ///< its columns point forward, left and up
  std::optional<Mat3> torso, head;
  std::array<LimbDirections, 2> leg;
  std::array<std::optional<Vec3>, 2> foot;  ///< along the sole, forward
  std::array<std::optional<LimbDirections>, 2> arm;
};

/// The joints that a captured motion drives; -1 where the skeleton has none.
struct LimbJoints {
  std::array<std::array<int, 3>, 2> hip, shoulder;  ///< flexion, adduction or abduction, rotation
  std::array<int, 2> knee, ankle, elbow;
  std::array<int, 3> lumbar;
  int neck = -1;
};
/// Throws InputError where a joint of the legs is missing, or the axes of a ball joint are not perpendicular.
LimbJoints limbJoints(const Skeleton& skeleton);

/// q of R = R(e1, q1) R(e2, q2) R(e3, q3) for perpendicular unit axes, |q2| <= pi/2; where |q2| is pi/2 only q1 + q3 or
/// their difference is known, and q1 is 0. The other solution is (q1 + pi, pi - q2, q3 + pi).
std::array<double, 3> threeAngles(const Mat3& R, const std::array<Vec3, 3>& axes);

/// What of the hinge's axis is taken from LimbDirections::hinge: the axis is along upper x lower + weight * hinge.
/// upper x lower is the sine of the bend long: at a knee bent by more than 6 degrees the two bones decide, as far as
/// their plane agrees with the hinge (a knee that is a little overstretched turns the thigh no other way). An elbow
/// never is straight in motion, and nothing else shows how the arm is twisted.
inline constexpr double knee_hinge_weight = 0.1, elbow_hinge_weight = 0.01;

/// Joint values that turn the skeleton's bones into those directions, written into q (what is not known stays); each
/// angle that is not held within half a turn by its own nature is the one nearest to what q held before.
void setDirections(const Skeleton& skeleton, const LimbJoints& joints, const BodyDirections& body,
                   std::vector<double>& q);

/// The rotation about a perpendicular axis that takes unit vector a to b (b != -a).
Mat3 shortestTurn(const Vec3& a, const Vec3& b);

}  // namespace gambeson
