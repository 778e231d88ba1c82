#pragma once
/// Where on the body: parts that a wearer would name, finer than the links of the skeleton.

#include <string>
#include <vector>

#include "human/body/body.hpp"

namespace gambeson {

/// Each link that has a surface is a zone by its own name ("thigh_left", "upper_arm_right", "head"), but:
///   hips      the link "pelvis"
///   waist     of the link "torso" what lies below kWaistShare of the way from the lumbar joint (the link's origin) up
///   to
///             the shoulder joints' middle
///   chest     of the torso what lies above that, up to the armpits, and the median line from there on
///   shoulder_left, shoulder_right
///             what straps and yokes lie on: of the torso all above the level of the armpits (to the side of the median
///             plane that it is on), and of the upper arm its top, down to the armpit.
/// The armpit lies below the shoulder joint by the radius of the arm: the smallest semi-axis of the largest ellipsoid
/// of the upper arm, or, where it has none, 3 % of the stature, as in our manikins (50 to 57 mm of 1.76 m). Points are
/// material: they belong to where they lie in their own link's frame, however the body moves. A human without the links
/// torso, upper_arm_left and upper_arm_right has links and hips alone.
class BodyZones {
 public:
  static constexpr double kWaistShare = 0.4, kArmOfStature = 0.03, kMedian_m = 1e-6;

  explicit BodyZones(const Human& human);

  /// From head to foot where the body has them, the left before the right.
  const std::vector<std::string>& names() const { return names_; }
  /// The zone of a point that is given in a link's frame; the link has a surface.
  int of(int link, const Vec3& p_L) const;
  /// The zone of each vertex of a skin, by its place in the bind posture.
  std::vector<int> ofSkin(const Skin& skin) const;

 private:
  int add(const std::string& name);

  std::vector<std::string> names_;
  std::vector<int> zone_;  ///< of each link; -1 without surface
  int torso_ = -1, chest_ = -1, waist_ = -1;
  int shoulder_[2]{-1, -1}, arm_[2]{-1, -1};  ///< zones and links, left then right
  Vec3 up_, left_, middle_;                   ///< of the torso, in its frame; `middle` between the shoulder joints
  double armpit_m_ = 0;                       ///< below the shoulder joints
  Vec3 along_[2];                             ///< unit, down the upper arm, in its frame
};

}  // namespace gambeson
