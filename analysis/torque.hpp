#pragma once
/// What contact costs at the joints: the torque of the cloth's forces about each joint axis.

#include <span>
#include <string>
#include <vector>

#include "human/body/body.hpp"
#include "human/motion/motion.hpp"

namespace gambeson {

/// What the cloth gave to one link over a window, in world axes.
struct LinkImpulse {
  Vec3 force_Ns;    ///< ∫ F dt
  Vec3 moment_Nms;  ///< ∫ (p - o(t)) x F dt about the origin o of the link's frame, wherever it is at t
};

/// One window of the run: at most 10 ms, so that the mean over it is a force.
struct ContactWindow {
  double start_s = 0, end_s = 0;
  std::vector<LinkImpulse> links;  ///< one per link of the skeleton
  double middle() const { return 0.5 * (start_s + end_s); }
  double duration() const { return end_s - start_s; }
};

/// Which links count at a joint. `distal_segment`: only the segment next to the joint (Man 2006, ch. 5); `all_distal`:
/// every link distal of it, which is the joint's share in the virtual work of all contact forces.
enum class TorqueCounting { distal_segment, all_distal };

/// The links whose contact counts at a joint. The distal segment is the first link with mass or shape down the chain
/// (the massless links between the axes of a hip are passed through), with the links fixed to it.
std::vector<int> countedLinks(const Human& human, int joint, TorqueCounting counting);

/// The joints that move by themselves: not fixed, not mimics.
std::vector<int> movingJoints(const Skeleton& skeleton);

/// The contact torque of each of `joints` at one posture [Nm] (prismatic: the force along the axis [N]):
///     tau = a · Σ_s (L_s + (o_s - c) x J_s) / duration
/// with the axis a fixed in the parent link, c the joint's centre, o_s the origin of link s, all in the world.
/// Positive: the cloth pushes the distal part towards positive joint values. The torque that the wearer's muscles must
/// add is the opposite, -tau.
std::vector<double> contactTorques(const Human& human, const Posture& posture, std::span<const LinkImpulse> impulses,
                                   double duration_s, std::span<const int> joints, TorqueCounting counting);

/// Torques over a run: value[w][j] of window w and joint joints[j], at the middle of the window.
struct TorqueSeries {
  std::vector<int> joints;
  std::vector<double> time_s;
  std::vector<std::vector<double>> value;
  std::vector<double> of(int joint) const;  ///< the series of one joint, by its index in the skeleton
};

/// contactTorques for each window, in the posture at its middle. Exact where the force is constant and the link origin
/// moves evenly against the joint; otherwise of second order in the window. `motion_start_s` is the time of the run at
/// which the motion's time is 0.
TorqueSeries torqueSeries(const Human& human, const Motion& motion, double motion_start_s,
                          std::span<const ContactWindow> windows, std::span<const int> joints, TorqueCounting counting);

}  // namespace gambeson
