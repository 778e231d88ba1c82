#pragma once
/// What a skin receives in a window, vertex by vertex, and what that is at the joints.
///
/// The torque of a joint is the generalised force of all contact on the skin: with f_v the force on vertex v and x_v(q)
/// where the skin puts it,
///   tau_j = sum_v c_jv f_v . dx_v/dq_j,
/// by central differences of the skin at the window's middle. It needs no border between segments: virtual work knows
/// how much of a vertex near a joint goes with it. c_jv is 1 where all distal contact counts; where the segment next to
/// the joint does, it is the share of that segment in the vertex's distal weights.
///
/// Beside it stands the sum over segments, as for bodies of shapes: each vertex belongs whole to the link of its
/// largest weight, and the moments about the joint of those that are distal are added; and the same with the border
/// between what is distal and what is not moved along the skin by 2 cm towards the trunk and away from it, which tells
/// how much that border decides. Last, the generalised force of the normal parts alone: what presses, without friction.

#include "cases/wear/scene/scenario.hpp"

namespace gambeson {

class SkinLedger {
 public:
  /// The scenario's human has a skin.
  explicit SkinLedger(const Scenario& scenario);

  /// Columns of the table "skin" after start_s and end_s: for each moving joint NAME_Nms (generalised),
  /// NAME_segments_Nms (by largest weight), NAME_proximal_Nms and NAME_distal_Nms (border moved), NAME_normal_Nms; N s
  /// for prismatic ones. Of the contact on the skin: the wearer adds the opposite.
  static std::vector<std::string> columns(const Scenario& scenario);
  static constexpr int kPerJoint = 5;
  /// The column of a moving joint; `what`: "", "_segments", "_proximal", "_distal" or "_normal".
  static std::string column(const Scenario& scenario, int joint, const std::string& what);
  static constexpr double kBorder_m = 0.02;

  /// `pressing`: the normal part of what is received.
  void add(const MaterialPoint& touched, const Vec3& received, const Vec3& pressing);
  /// The row of a window, at its middle.
  std::vector<double> row(double middle_s) const;
  void clear();

  const std::vector<Vec3>& received() const { return received_; }  ///< of each vertex [N s]
  const std::vector<double>& normal() const { return normal_; }    ///< sums of magnitudes

 private:
  struct JointFacts {
    int joint = 0;
    std::vector<char> distal, counted;  ///< of each link
    /// Of each vertex: 1 counts, with the border where the weights say, moved proximally, moved distally.
    std::vector<char> segments, proximal, distally;
  };
  double share(const JointFacts& joint, int vertex) const;

  const Scenario& scenario_;
  const Skin& skin_;
  std::vector<JointFacts> joints_;
  std::vector<Vec3> received_, pressing_;
  std::vector<double> normal_;
};

}  // namespace gambeson
