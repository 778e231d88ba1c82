#pragma once
/// Joint moments that hold a posture still.

#include <vector>

#include "human/motion/motion.hpp"

namespace gambeson {

/// A mass that the human carries, at a point of a link.
struct CarriedMass {
  int link = 0;
  Vec3 point_L;  ///< in the link's frame
  double mass_kg = 0;
};

/// What the ground gives: a vertical force at each foot that stands.
struct GroundReaction {
  struct Foot {
    int link = -1;
    Vec3 centre_W;       ///< of pressure [m]
    double force_N = 0;  ///< upwards
  };
  std::vector<Foot> feet;
  /// Horizontal distance by which the centres of pressure were moved from the feet's lowest points, so that the
  /// resultant passes below the centre of mass [m]. More than half a foot's breadth says that the posture would tip
  /// over sideways and half its length to the front or back.
  double shift_m = 0;
};

/// The centre of mass of links and load [m].
Vec3 centreOfMass(const Human& human, std::span<const Pose> link_poses, std::span<const CarriedMass> carried);

/// Feet whose lowest point lies within `reach_m` of the lowest foot's share the weight: with two feet in proportion to
/// where the centre of mass projects on the line between their lowest points, held to its ends; both centres of
/// pressure are then moved by one horizontal vector, so that the resultant passes through the centre of mass. With that
/// the whole body is in balance. Feet are the ellipsoids of footOf. Gravity is 9.81 m/s² downwards.
GroundReaction groundReaction(const Human& human, std::span<const Pose> link_poses,
                              std::span<const CarriedMass> carried, double reach_m = 1e-3);

/// Moments of the joints [N m] (forces of sliding ones [N]), positive towards positive joint values, that balance the
/// weight of everything distal and the ground's forces on it: tau_j = dV/dq_j - sum over feet of F . dx/dq_j, with V
/// the potential energy and the pelvis held. 0 for fixed joints and joints that follow others.
std::vector<double> jointMoments(const Human& human, std::span<const Pose> link_poses,
                                 std::span<const CarriedMass> carried, const GroundReaction& ground);

/// A rifle held in both hands: half its mass at each hand's centre of mass. Throws InputError without the links
/// hand_left and hand_right.
std::vector<CarriedMass> rifleInHands(const Human& human, double mass_kg);

/// What holds one joint of a posture still.
struct StaticMoment {
  double moment_Nm = 0;  ///< signed
  double foot_part = 0;  ///< of the weight, on the foot beyond the joint; 0 where there is none
  double lever_m = 0;    ///< at which the ground's force on that foot passes the joint's axis
};

/// Every hundredth of a motion, from 0 to its end [s].
std::vector<double> hundredthsOf(const Motion& motion);

/// Per joint the moment of largest size that holds the postures of a motion still, over the times when both feet stand
/// (a still body cannot step), at the hundredths of the motion. Throws InputError where they never do.
std::vector<StaticMoment> peakStaticMoments(const Human& human, const Motion& motion,
                                            std::span<const CarriedMass> carried);

}  // namespace gambeson
